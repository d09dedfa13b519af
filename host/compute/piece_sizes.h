/* How a scene of trigrains is laid out on a device: slots, regions, list capacities, cells, skins;
 * and the parameters that its kernels read. */
#ifndef OZ_COMPUTE_PIECE_SIZES_H
#define OZ_COMPUTE_PIECE_SIZES_H

#include "compute/piece_arrays.h"

/* Constants of a scene, in double, and its lists' skins and cells. Fails with OZ_ERR_INPUT when
 * there are more walls than the kernels hold. */
OzStatus oz_piece_sizes_parameters(OzPieceParameters *parameters, const OzScene *scene,
                                   const OzGrains *grains);

/* Sizes that a member of this kind needs. */
void oz_piece_sizes_choose(OzPieceSizes *sizes, const OzPieceParameters *parameters,
                           const OzScene *scene, const OzGrains *grains,
                           const OzPieceSwitches *switches);

/* Makes sizes large enough for another member too. */
void oz_piece_sizes_join(OzPieceSizes *sizes, const OzPieceSizes *other);

/* Enlarges the capacities that control asks for, with room to spare. */
void oz_piece_sizes_grow(OzPieceSizes *sizes, const OzPieceControl *control,
                         const OzPieceSwitches *switches);

#endif
