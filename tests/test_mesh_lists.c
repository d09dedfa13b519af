/* Lists of the triangles near grains must not change a bit: a crowd in a box of many triangles that
 * turns, with other skins, in tiles, with lists that are too small, beside the host reference,
 * which has none. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "mesh_files.h"
#include "sim/rods_private.h"

enum { CELLS = 8, STEPS = 200, LONG = 1000 };

static const char *box, *inner;

/* One corner of a side's grid, in the order in which all sides are written. */
static void put_corner(FILE *file, int side, int i, int j)
{
    int axis = side / 2, up = side % 2;
    double at[3];
    at[axis] = up ? 1 : -1;
    at[(axis + 1) % 3] = 2.0 * i / CELLS - 1;
    at[(axis + 2) % 3] = 2.0 * j / CELLS - 1;
    fprintf(file, "v %.9g %.9g %.9g\n", at[0], at[1], at[2]);
}

/* A box from -1 to 1 of 12 CELLS^2 triangles, fronts inside. */
static const char *fine_box(void)
{
    FILE *file = new_mesh("obj");
    for (int side = 0; side < 6; side++) {
        for (int corner = 0; corner < (CELLS + 1) * (CELLS + 1); corner++) {
            put_corner(file, side, corner % (CELLS + 1), corner / (CELLS + 1));
        }
        for (int cell = 0; cell < CELLS * CELLS; cell++) {
            int row = CELLS + 1, first = side * row * row + cell / CELLS * row + cell % CELLS + 1;
            int at[] = {first, first + 1, first + row + 1, first + row};
            int one = at[side % 2 ? 3 : 1], other = at[side % 2 ? 1 : 3];
            fprintf(file, "f %d %d %d %d\n", at[0], one, at[2], other);
        }
    }
    fclose(file);
    return mesh_paths[mesh_count - 1];
}

/* The first grain is so fast that it is through with any list after a step. */
static void open_crowd(Rig *rig, const char *precision, double skin)
{
    rig_open(rig, mesh_crowd, precision, box, inner);
    rig->scene.skin = skin;
    throw_grains(&rig->grains, 0.8, 20);
    for (int k = 0; k < 3; k++) {
        rig->grains.velocity[k] *= 5;
    }
}

/* Skins of 2 mm reach across the box; those of 1 nm are used up at each step. */
static void skins_do_not_show(void **state)
{
    (void)state;
    static const double skins[] = {2e-3, 0, 1e-9};
    OzDevice device = shaped_device(NATIVE);
    OzSnapshot first = {0};
    for (int k = 0; k < 4; k++) {
        Rig rig;
        device.small_most = k < 3 ? OZ_DEVICE_SMALL_MOST : 0; /* in tiles, too */
        open_crowd(&rig, "float", skins[k % 3]);
        OzSim *sim = start_sim(&rig, &device);
        OzSnapshot seen = state_at(&rig, sim, LONG);
        assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
        if (k > 0) {
            assert_same_bits(&seen, &first);
            oz_snapshot_free(&seen);
        } else {
            first = seen;
        }
        oz_sim_free(sim);
        rig_close(&rig);
    }
    oz_snapshot_free(&first);
}

/* A list that is too small is not used, and grows when lists are renewed. */
static void lists_grow(void **state)
{
    (void)state;
    Rig rig;
    OzSnapshot seen[2];
    OzDevice device = shaped_device(NATIVE);
    open_crowd(&rig, "float", 0);
    for (int k = 0; k < 2; k++) {
        OzSim *sim = start_sim(&rig, &device);
        OzSizes sizes = *oz_rods_sizes(sim);
        if (k) {
            sizes.face_capacity = 1;
            must(oz_arrays_resize(&sim->arrays, &sizes));
            oz_rods_control(sim, 0)->truth = OZ_SPRINGS_AT_NONE;
        }
        seen[k] = state_at(&rig, sim, LONG);
        assert_true(oz_rods_sizes(sim)->face_capacity > 2);
        assert_true(oz_rods_sizes(sim)->face_capacity >= oz_rods_control(sim, 0)->faces_needed);
        assert_true(!k || oz_sim_counts(sim).growths > 0);
        oz_sim_free(sim);
    }
    assert_same_bits(&seen[0], &seen[1]);
    oz_snapshot_free(&seen[0]);
    oz_snapshot_free(&seen[1]);
    rig_close(&rig);
}

/* As in test_meshes: after 200 steps with hits rounding has grown a thousandfold; a triangle that
 * is not seen shows in the first digits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    Rig rig;
    OzDevice device = shaped_device(NATIVE);
    device.small_most = 0; /* double in tiles, as in test_swinging_walls: the same program */
    open_crowd(&rig, "double", 0);
    OzSim *sim = start_sim(&rig, &device);
    OzSnapshot seen = state_at(&rig, sim, STEPS);
    rig_start(&rig);
    rig_advance(&rig, STEPS);
    assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < 1e-8);
    assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < 1e-9);
    assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                     oz_contact_list_sum(&rig.now.contacts).walls);
    oz_snapshot_free(&seen);
    oz_sim_free(sim);
    rig_close(&rig);
}

static int open_meshes(void **state)
{
    box = fine_box();
    inner = mesh_of_text(mesh_fence, "obj");
    return open_rig_device(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skins_do_not_show),
        cmocka_unit_test(lists_grow),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_meshes, close_rig_device);
}
