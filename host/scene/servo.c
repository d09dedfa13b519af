/* Counting servo walls. */
#include "scene/servo.h"

int oz_servo_number(const OzScene *scene, int wall)
{
    int number = 0;
    for (int w = 0; w < wall; w++) {
        number += scene->walls[w].servo.present;
    }
    return number;
}
