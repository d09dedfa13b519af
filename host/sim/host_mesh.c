/* Meshes on the host: the kernels' search, triangle by triangle. */
#include "sim/host_mesh.h"

#include "sim/dialect.h"

#include "kernels/mesh_touch.h"

#include <stdlib.h>
#include <string.h>

/* One grain and the triangles near it. */
typedef struct View {
    const OzWallMesh *mesh;
    OzVec3 from;
    OzMeshGrain grain;
    int ends;
    const int *face;
    int count;
} View;

static OzMeshFace face_of(const View *view, int face)
{
    const double *p = view->mesh->corners + 9 * (size_t)face;
    OzVec3 corner = oz_dialect_load3(p);
    return (OzMeshFace){oz_minus(view->from, corner), oz_minus(oz_dialect_load3(p + 3), corner),
                        oz_minus(oz_dialect_load3(p + 6), corner), OZ_MESH_KEY(face, 0)};
}

static void take_better(const OzMeshTouches *touches, OzMeshOffer offer, double *most,
                        OzMeshTouch *touch)
{
    OzMeshTouch other = {.key = offer.key, .place = offer.place, .distance = offer.at.distance};
    oz_dialect_store3(other.normal, offer.at.normal);
    double left = offer.counts ? oz_mesh_left(touches, &other) : 0;
    if (left > *most) {
        *most = left;
        *touch = other;
    }
}

static bool find_next(const View *view, const OzMeshTouches *touches, int between,
                      OzMeshTouch *touch)
{
    double most = 0;
    OzMeshEnds tips = {touches->tip, touches->tail};
    for (int i = 0; i < view->count; i++) {
        OzMeshFace face = face_of(view, view->face[i]);
        for (int end = 0; end < view->ends; end++) {
            take_better(touches, oz_mesh_offer_end(face, view->grain, end), &most, touch);
        }
        bool may = between && oz_mesh_may_between(tips, face, view->grain);
        for (int part = 0; may && part < OZ_WALL_SHAFT_PARTS; part++) {
            take_better(touches, oz_mesh_offer_shaft(tips, face, view->grain, part), &most, touch);
        }
    }
    return most > 0;
}

static bool find_touches(const View *view, OzMeshTouches *touches)
{
    int is_long = oz_dot(view->grain.half_shaft, view->grain.half_shaft) > 0;
    int rounds = OZ_MESH_ROUNDS;
    bool fits = true;
    oz_mesh_begin(touches, view->grain.radius);
    for (int between = 0; between <= is_long; between++) {
        OzMeshTouch touch;
        while (fits && rounds-- > 0 && find_next(view, touches, between, &touch)) {
            fits = oz_mesh_add(touches, touch);
        }
        oz_mesh_note_ends(touches);
    }
    return fits;
}

static void take(OzHostMesh *found, const OzMeshTouches *touches, double *memory)
{
    int slot_of[OZ_MESH_SLOTS];
    oz_mesh_place(touches, memory, slot_of, found->spring_to);
    for (int i = 0; i < touches->count; i++) {
        const OzMeshTouch *touch = &touches->at[i];
        OzHostTouch *to = &found->at[slot_of[i]];
        *to = (OzHostTouch){.present = true,
                            .place = touch->place,
                            .distance = touch->distance,
                            .push = touch->push};
        memcpy(to->normal, touch->normal, sizeof to->normal);
    }
}

bool oz_host_mesh_find(OzHostMesh *found, const OzPhysics *physics, int w, OzVec3 from,
                       OzVec3 half_shaft, double radius, double *memory)
{
    const OzWallMesh *mesh = physics->mesh[w];
    OzMeshTouches touches = {.radius = radius};
    double low[3], high[3], centre[3], half[3];
    int *faces = NULL, count = 0;
    bool fits = true;
    const double *frame = physics->swing[w].frame;
    *found = (OzHostMesh){.spring_to = {0}};
    from = oz_wall_swing_back(frame, from);
    half_shaft = oz_wall_swing_back(frame, half_shaft);
    oz_dialect_store3(centre, from);
    oz_dialect_store3(half, half_shaft);
    for (int k = 0; k < 3; k++) {
        low[k] = centre[k] - fabs(half[k]) - radius;
        high[k] = centre[k] + fabs(half[k]) + radius;
    }
    if (physics->parameters.wall[w].shape.gone == 0 &&
        oz_wall_mesh_near(mesh, low, high, &faces, &count) == OZ_OK) {
        View view = {.mesh = mesh,
                     .from = from,
                     .grain = {half_shaft, radius, mesh->two_sided},
                     .ends = physics->ends,
                     .face = faces,
                     .count = count};
        fits = find_touches(&view, &touches);
    }
    take(found, &touches, memory);
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        oz_wall_swing_turn(frame, found->at[k].normal);
    }
    free(faces);
    return fits;
}

void oz_host_mesh_hand_over(const OzHostMesh *found, OzMemory memories[OZ_MESH_SLOTS])
{
    OzMemory kept[OZ_MESH_SLOTS];
    memset(kept, 0, sizeof kept);
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        int to = found->spring_to[k];
        if (to >= 0) {
            kept[to].stretch = oz_add(kept[to].stretch, memories[k].stretch);
            kept[to].turned = oz_add(kept[to].turned, memories[k].turned);
        }
    }
    memcpy(memories, kept, sizeof kept);
}

double *oz_host_mesh_memory(const OzPhysics *physics, double *memory, int64_t grain, int mesh)
{
    return memory + (grain * physics->meshes + mesh) * OZ_MESH_SLOTS * OZ_MESH_MEMORY;
}
