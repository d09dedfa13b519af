/* Pictures that are no results. */
#include "run/glances.h"

OzStatus oz_glances_open(OzGlances *glances, OzRenderQueue *render_queue, OzPictures *movie,
                         const OzPicturesSettings *settings, const OzScene *scene)
{
    glances->render_queue = render_queue;
    glances->movie = movie;
    glances->settings = *settings;
    return oz_pictures_create(&glances->own, &glances->settings, scene);
}

static OzStatus finish_own(OzGlances *glances)
{
    OzStatus status = oz_render_queue_finish(glances->render_queue, glances->own);
    glances->own = NULL;
    return status;
}

OzStatus oz_glances_begin(OzGlances *glances)
{
    return glances->movie ? finish_own(glances) : OZ_OK;
}

bool oz_glances_wait(const OzGlances *glances)
{
    return glances->render_queue && oz_live_waits(oz_render_queue_live(glances->render_queue)) &&
           oz_render_queue_is_idle(glances->render_queue);
}

OzStatus oz_glances_show(const OzGlances *glances, const OzSnapshot *now)
{
    return oz_render_queue_add(glances->render_queue, glances->own ? glances->own : glances->movie,
                               now, OZ_PICTURES_LIVE);
}

OzStatus oz_glances_end(const OzGlances *glances, const OzSnapshot *now)
{
    return glances->own ? oz_glances_show(glances, now) : OZ_OK;
}

OzStatus oz_glances_take(const OzGlances *glances, const OzScene *next)
{
    return oz_render_queue_take(glances->render_queue, glances->own, next, "");
}

OzStatus oz_glances_close(OzGlances *glances)
{
    OzStatus status = finish_own(glances);
    *glances = (OzGlances){0};
    return status;
}
