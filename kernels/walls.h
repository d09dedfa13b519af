/* THE list of walls. Scene choices, the kernels' and the host's distances, the room for grains and
 * pictures are made of it: a row whose functions do not exist does not compile. Names alone:
 * host/scene reads it too. */
#pragma once

/* X(NAME, name, choice, fine, edged), a row each, of rods' walls:
 *   fine   1: kernels/wall_<name>.h has oz_wall_<name>_fine, too: the overlap of light contacts
 * with all digits that places carry; 0: precision: float refuses scenes that need it
 *   edged  1: a thin sheet with edges and grains on both sides; 2: a body that is convex towards
 * grains; shafts touch both between their ends, too. These come last, and have
 * oz_wall_<name>_middle and oz_wall_<name>_flush, too (wall.h)
 * kernels/wall_<name>.h has oz_wall_<name>(from, wall) and is included by wall.h;
 * host/scene/wall_shape.c fills the numbers that it reads (shape_<name>); host/model/fill_region.c
 * bounds the room for grains placed at random (bound_by_<name>). An empty
 * choice is for sides of other walls alone: a cylinder that is not upright about the origin is a
 * tube, or a band where its ends are open, and its outside, like a sphere's, is an obstacle to
 * rods, or a solid where its ends are closed. The keys of a wall name it under
 * `.kinds` in host/scene/rows.c. Pictures show kinds without a drawing of their own
 * (host/draw/container.c) by level lines, found by distance. */
#define OZ_WALLS(X)                                                                                \
    X(PLANE, plane, "plane", 1, 0)                                                                 \
    X(CYLINDER, cylinder, "cylinder", 1, 0)                                                        \
    X(TUBE, tube, "", 0, 0)                                                                        \
    X(SPHERE, sphere, "sphere", 0, 0)                                                              \
    X(MESH, mesh, "mesh", 0, 0)                                                                    \
    X(RECTANGLE, rectangle, "rectangle", 0, 1)                                                     \
    X(BAND, band, "", 0, 1)                                                                        \
    X(OBSTACLE, obstacle, "", 0, 2)                                                                \
    X(SOLID, solid, "", 0, 2)

/* X(NAME, name, choice), of rods' walls that are made of these, as a box is of planes and a disc is
 * a band: host/scene/wall_shape.c makes them (sides_<name>), host/model/fill_region.c as above. */
#define OZ_COMPOUND_WALLS(X)                                                                       \
    X(BOX, box, "box")                                                                             \
    X(DISC, disc, "disc")                                                                          \
    X(CONE, cone, "cone")

/* X(NAME, name, choice, rank), of trigrains: a smooth straight wall from one point to another; a
 * toothed floor of a width about a point; two slopes with an opening between them, and upright
 * sides above; the inside of a toothed circle; bottom and two sides. rank   0: encloses nothing;
 * else the scene's first wall of the highest rank is the one that grains placed at random lie in
 * host/model/element_walls.c cuts each into strips of triangles (add_<name>),
 * host/model/fill_region_flat.c says whether a circle lies inside (inside_<name>). */
#define OZ_TRIGRAINS_WALLS(X)                                                                      \
    X(SEGMENT, segment, "segment", 0)                                                              \
    X(FLOOR, floor, "floor", 1)                                                                    \
    X(HOPPER, hopper, "hopper", 3)                                                                 \
    X(DRUM, drum, "drum", 3)                                                                       \
    X(VESSEL, vessel, "vessel", 2)

#define OZ_WALLS_ID(NAME, name, choice, fine, edged) OZ_WALL_##NAME,
#define OZ_WALLS_COMPOUND_ID(NAME, name, choice)     OZ_WALL_##NAME,
#define OZ_WALLS_FLAT_ID(NAME, name, choice, rank)   OZ_WALL_##NAME,
typedef enum OzWallKind {
    OZ_WALLS(OZ_WALLS_ID) OZ_COMPOUND_WALLS(OZ_WALLS_COMPOUND_ID)
        OZ_TRIGRAINS_WALLS(OZ_WALLS_FLAT_ID) OZ_WALLS_END
} OzWallKind;
