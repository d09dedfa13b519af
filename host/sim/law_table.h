/* The constants of each two materials of grains, and of each wall and each of these
 * (kernels/material.h). */
#pragma once

#include "sim/rods_fields.h"

enum { OZ_LAW_TABLE_MOST = OZ_MATERIALS_MAX * (OZ_MATERIALS_MAX + OZ_WALLS_MAX) };

/* Fills the rows of a scene with so many kernel walls, in SI; none where grains are of one
 * material. */
void oz_law_table_fill(OzLawConstants table[OZ_LAW_TABLE_MOST], const OzScene *scene,
                       const int *wall_order, int walls);

/* Uploads a member's, and what its grains are of; p: its parameters. */
OzStatus oz_law_table_write(OzArrays *arrays, int member, const OzMember *of, const int *wall_order,
                            const OzParameters *p);
