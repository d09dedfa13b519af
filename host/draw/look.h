/* What a picture shows, and what it is drawn by. */
#pragma once

#include "model/snapshot.h"

/* Who draws rods: a GPU by OpenGL where there is one, else the host; one of two OpenGL libraries,
 * whatever they draw with; the host. Flat grains are always drawn by OpenGL. */
typedef enum OzGlBackend { OZ_GL_AUTO, OZ_GL_EGL, OZ_GL_OSMESA, OZ_GL_HOST } OzGlBackend;

/* What a picture shows. Start from oz_renderer_look and change size, views and colour at will: the
 * framing is in metres and holds for any of them. */
typedef struct OzLook {
    int width, height; /* pixels, OZ_PICTURE_SIDE_MIN to _MAX, any aspect */
    OzView views[2];
    int view_count; /* 1, or 2 side by side */
    OzColour colour;
    double height_low, height_high; /* m: the vertical range that the camera frames */
    double speed_high;              /* m/s at the top of the colour bar, for OZ_COLOUR_SPEED */
    double force_high;              /* N, the same for OZ_COLOUR_FORCE, and the scale of chains */
    bool chains;                    /* forces as lines; rods and spheres thin */
    double centre[2];               /* m: x and y at the middle of the picture */
    double half_width; /* m: no point of what is framed is farther from the middle along x or y */
    double half_sides[2]; /* m: the same of each of them; 0: half_width of both                  */
    double cut;           /* m: the cut view shows what lies at y above this */
    double elevation;     /* rad: how far above the horizon the camera stands, but for: */
    double free_azimuth, free_elevation; /* rad: of OZ_VIEW_FREE (scene_types.h) */
    double zoom;                         /* times as large as what fits; 0: 1 */
    double target[3]; /* m: what is in the middle of the picture, instead of what is framed's */
    bool has_target;
    int64_t follow; /* number of the grain that is there instead */
    bool has_follow;
    bool is_round;       /* what is framed is as wide from all sides           */
    bool plain;          /* on white, no overlay                               */
    bool no_legend;      /* the overlay does not say what colours mean         */
    float background[3]; /* red, green, blue, 0 to 1 */
    bool has_background;
    bool bare;            /* grains alone on white: no container, no overlay */
    bool flat;            /* seen straight on in the plane x-y, as trigrains are: height_low and
                           * height_high are of y, views and cut say nothing */
    bool cut_outlines;    /* the cut view: grains before the plane as faint outlines */
    bool outlines, beams; /* flat: of grains                              */
    bool settles;         /* the time is of settling, before time 0                        */
    const char *caption;  /* above the lower edge; NULL: none; borrowed                    */
    double strobe;        /* flat: s between states that are laid over each other, for the caption;
                           * 0 for a single one */
} OzLook;
