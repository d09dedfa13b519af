/* Grains of several materials: each contact has the constants of its own two, from a table.
 * OZ_MATERIALS is the number of materials among the grains; where it is 1 one set serves all grains
 * and one each wall, as if there were none. OpenCL C only. */
#pragma once

#if OZ_MATERIALS > 1

/* The constants in these rows of the table. */
OZ_INLINE OZ_LAW oz_material_law(const OzWork *w, const int *rows)
{
    real a[4], b[4], c[4];
    oz_lanes_load4(w->law_table, rows, OZ_LAW_ROW, 0, a);
    oz_lanes_load4(w->law_table, rows, OZ_LAW_ROW, 4, b);
    oz_lanes_load4(w->law_table, rows, OZ_LAW_ROW, 8, c);
    OZ_LAW law = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], c[0]};
    return law;
}

/* Of the grains in slots a and b. */
OZ_INLINE OZ_LAW oz_material_of_pairs(const OzWork *w, const int *a, const int *b)
{
    int rows[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        int one = w->material[w->id[a[l]]], other = w->material[w->id[b[l]]];
        rows[l] = one * OZ_MATERIALS + other;
    }
    return oz_material_law(w, rows);
}

/* Of the grains in slots at a wall. */
OZ_INLINE OZ_LAW oz_material_at_wall(const OzWork *w, int wall, const int *slots)
{
    int rows[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        rows[l] = (OZ_MATERIALS + wall) * OZ_MATERIALS + w->material[w->id[slots[l]]];
    }
    return oz_material_law(w, rows);
}

#define OZ_MATERIAL_PAIR_LAW(w, a, b, common)   oz_material_of_pairs(w, a, b)
#define OZ_MATERIAL_WALL_LAW(w, wall_of, slots) oz_material_at_wall(w, wall_of, slots)
#else
#define OZ_MATERIAL_PAIR_LAW(w, a, b, common)   common
#define OZ_MATERIAL_WALL_LAW(w, wall_of, slots) w->parameters->wall[wall_of].law
#endif
