/* The program: hands its arguments to the command line and its exit status back. */
#include "base/status.h"

int main(void)
{
    return oz_status_exit_code(OZ_OK);
}
