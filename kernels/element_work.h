/* Elements in the kernels' memory. OpenCL C only. Switches: OZ_ORDER (words of a coordinate: 5 is
 * gear4, 3 velocity-verlet), OZ_MOVING (some wall moves), OZ_DISCS and OZ_BEAMS (the scene has
 * any), OZ_STRENGTH (beams break or yield), OZ_YIELD (they yield), OZ_SUBSTEPS, OZ_LEDGER,
 * OZ_IMPULSES, OZ_TRIANGLE_FIELD (contacts of triangles have a potential), OZ_FORCE_POINT,
 * OZ_DAMPING_SHEAR. The law of discs is no switch: it is a number in the parameters, of its own for
 * each wall. */
#pragma once

#include "kernels/element_fields.h"
#include "kernels/element_layout.h"
#include "kernels/triangle_field.h"

/* What the files of every model call these. Pairs have no springs here. */
typedef OzElementParameters OzParameters;
typedef OzElementControl OzControl;
typedef OzElementSizes OzSizes;
#define OZ_FIELDS         OZ_ELEMENT_FIELDS
#define OZ_RECORD         OZ_ELEMENT_RECORD
#define OZ_R_SKIN         OZ_PR_SKIN
#define OZ_REFERENCE      OZ_ELEMENT_REFERENCE
#define OZ_REFERENCE_SKIN OZ_PF_SKIN
#define OZ_HISTORY        0
#define OZ_HOST_LISTS     0
#define OZ_ALL_PAIRS      0
#define OZ_TILES          0 /* loads are gathered in large scenes */

#define OZ_WORK_BODIES(w) ((w)->control->free_count)
#define OZ_WORK_SLOTS(w)  ((w)->z.free_slots)
#define OZ_WORK_HOLDS(w, slot)                                                                     \
    ((slot) < (w)->z.free_slots ? (slot) < (w)->control->free_count                                \
                                : (slot) - (w)->z.free_slots < (w)->control->wall_count)
#define OZ_WORK_ID(w, slot) (slot)

#include "kernels/member.h"

/* An element as contacts see it, in each lane. */
typedef struct OzElement {
    OzTriangle triangle; /* a disc's three corners are its centre */
    OzVec2 position;
} OzElement;

OZ_INLINE OzElement oz_element_work_element(const OzWork *w, const int *slots)
{
    OzElement element;
    real a[4], b[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER, a);
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER + 4, b);
    element.triangle.corner[0] = oz_vec2(a[0], a[1]);
    element.triangle.corner[1] = oz_vec2(a[2], a[3]);
    element.triangle.corner[2] = oz_vec2(b[0], b[1]);
    element.position = oz_vec2(b[2], b[3]);
    return element;
}

/* Velocity, angle and spin of the elements in slots. */
OZ_INLINE void oz_element_work_motion(const OzWork *w, const int *slots, OzVec2 *velocity,
                                      real *angle, real *angular_velocity)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_VELOCITY, words);
    *velocity = oz_vec2(words[0], words[1]);
    *angle = words[2];
    *angular_velocity = words[3];
}

OZ_INLINE void oz_element_work_label(const OzWork *w, const int *slots, real *radius,
                                     real *inverse_mass)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_RADIUS, words);
    *radius = words[0];
    *inverse_mass = words[1];
}
