/* Where the camera stands, and how the picture is divided. View coordinates have their origin at
 * the middle of what is framed, x to the right, y up and z towards the eye; their unit is a length
 * of the scene's size, so that all coordinates in shaders are of order one. */
#pragma once

#include "draw/look.h"

/* A view's part of the picture, pixels from the top left. */
typedef struct OzPanel {
    int x, width;              /* columns that the view may paint; it has all rows            */
    double middle_x, middle_y; /* where the origin of view coordinates comes to lie   */
} OzPanel;

/* Pixels from the top left. */
typedef struct OzBox {
    int x, y, width, height;
} OzBox;

typedef struct OzCamera {
    double azimuth, elevation; /* rad: where the eye stands, as in scene_types.h */
    double centre[3];          /* m, world: the origin of view coordinates           */
    double axes[3][3];         /* unit vectors x, y, z of view coordinates, in the world */
    double unit;               /* m: one unit of view coordinates                    */
    double distance;           /* units from the eye to the centre                   */
    double scale;              /* pixels per unit at the centre's depth              */
    double depth;              /* units: depths from -depth to depth are told apart  */
    double font;               /* pixels: the overlay's text size; 0 leaves it out   */
    double content_width, content_height; /* pixels that the framed volume covers     */
    int panel_count;
    OzPanel panels[2];
} OzCamera;

/* Of the look's view of that number. All views of a picture have one scale. */
OzCamera oz_camera_make(const OzLook *look, int view);

/* Whether two views of a picture are seen from the same side. */
bool oz_camera_agrees(const OzCamera *a, const OzCamera *b);

/* RGB, 0 to 1, behind all things. */
const float *oz_camera_background(const OzLook *look);

/* How far behind the middle view coordinates are, as the eye sees it: along the horizon where it
 * looks along that, else along its own direction. away[k]: by each unit of the k-th. */
void oz_camera_away(const OzCamera *camera, double away[3]);

/* The part of a panel where framed things, or anything between low and high (view coordinates x and
 * y), can appear. */
OzBox oz_camera_box(const OzCamera *camera, const OzLook *look, int panel, const double low[2],
                    const double high[2]);

/* A point of the world in view coordinates. */
void oz_camera_see(const OzCamera *camera, const double world[3], double view[3]);

/* A direction of the world (not scaled) in view coordinates. */
void oz_camera_turn(const OzCamera *camera, const double world[3], double view[3]);
