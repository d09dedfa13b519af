/* The order in which a view's parts are laid over each other on the host. */
#include "draw/host_drawing.h"

#include "draw/mesh_rows.h"
#include "draw/raster.h"

void oz_host_drawing_free(OzHostDrawing *drawing)
{
    oz_container_free(&drawing->container);
    for (int i = 0; i < 4; i++) {
        oz_layer_free(&drawing->glass[i / 2][i % 2]);
    }
}

OzStatus oz_host_drawing_begin(OzHostDrawing *drawing, const OzBodies *bodies, int view, OzBox *box)
{
    const OzLook *look = bodies->look;
    if (!look->bare) {
        OZ_PASS(oz_container_build(&drawing->container, bodies->snapshot, look, bodies->camera,
                                   look->views[view]));
    }
    *box = oz_bodies_box(bodies, view, look->bare ? 0 : drawing->container.high);
    return OZ_OK;
}

static void paint(const OzHostDrawing *drawing, const OzDrawn *drawn, const OzBodies *bodies,
                  int view, OzContainerMesh mesh)
{
    bool is_solid = mesh == OZ_CONTAINER_FLOORS || mesh == OZ_CONTAINER_OBSTACLES;
    oz_mesh_rows_paint(drawn, &drawing->container.meshes[mesh], bodies->camera, bodies->look, view,
                       is_solid ? OZ_MESH_SOLID : OZ_MESH_OVER);
}

static OzStatus lay(OzHostDrawing *drawing, const OzDrawn *drawn, const OzBodies *bodies, int view,
                    bool before)
{
    OzContainerMesh mesh = before ? OZ_CONTAINER_GLASS_BEFORE : OZ_CONTAINER_GLASS_BEHIND;
    return oz_layer_draw(&drawing->glass[view][before], drawn, &drawing->container.meshes[mesh],
                         bodies->camera, bodies->look, view);
}

static OzStatus draw_grains(const OzDrawn *drawn, const OzBodies *bodies, int view)
{
    OzRaster raster;
    OzStatus status = oz_raster_begin(&raster, drawn, bodies, view);
    if (status == OZ_OK) {
        oz_raster_draw(&raster);
    }
    oz_raster_end(&raster);
    return status;
}

OzStatus oz_host_drawing_draw(OzHostDrawing *drawing, const OzDrawn *drawn, const OzBodies *bodies,
                              int view)
{
    if (bodies->look->bare) {
        return draw_grains(drawn, bodies, view);
    }
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_FLOORS);
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_BEHIND);
    OZ_PASS(lay(drawing, drawn, bodies, view, false));
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_END_BEHIND);
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_OBSTACLES);
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_OUTLINES);
    OZ_PASS(draw_grains(drawn, bodies, view));
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_BEFORE);
    OZ_PASS(lay(drawing, drawn, bodies, view, true));
    paint(drawing, drawn, bodies, view, OZ_CONTAINER_END_BEFORE);
    return OZ_OK;
}
