/* Pictures that are no results. */
#include "run/glances.h"

OzStatus oz_glances_open(OzGlances *glances, OzRenderQueue *render_queue, OzPictures *movie,
                         const OzPicturesSettings *settings, const OzScene *scene)
{
    glances->render_queue = render_queue;
    glances->pictures = movie;
    glances->is_own = !movie;
    if (movie) {
        return OZ_OK;
    }
    glances->settings = *settings;
    return oz_pictures_create(&glances->pictures, &glances->settings, scene);
}

bool oz_glances_wait(const OzGlances *glances)
{
    return glances->pictures && oz_live_waits(oz_render_queue_live(glances->render_queue)) &&
           oz_render_queue_is_idle(glances->render_queue);
}

OzStatus oz_glances_show(const OzGlances *glances, const OzSnapshot *now)
{
    return oz_render_queue_add(glances->render_queue, glances->pictures, now, OZ_PICTURES_LIVE);
}

OzStatus oz_glances_end(const OzGlances *glances, const OzSnapshot *now)
{
    return glances->is_own ? oz_glances_show(glances, now) : OZ_OK;
}

OzStatus oz_glances_take(const OzGlances *glances, const OzScene *next)
{
    return glances->is_own
               ? oz_render_queue_take(glances->render_queue, glances->pictures, next, "")
               : OZ_OK;
}

OzStatus oz_glances_close(OzGlances *glances)
{
    OzStatus status =
        glances->is_own ? oz_render_queue_finish(glances->render_queue, glances->pictures) : OZ_OK;
    *glances = (OzGlances){0};
    return status;
}
