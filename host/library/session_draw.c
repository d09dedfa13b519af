/* One renderer, made by the first picture. */
#include "library/session_draw.h"

void oz_session_draw_size(const OzSession *session, int *width, int *height)
{
    const OzMovieSettings *movie = &session->scene.movie;
    *width = movie->present ? movie->width : 1280;
    *height = movie->present ? movie->height : 720;
}

static OzStatus open_renderer(OzSession *session)
{
    if (!session->renderer) {
        OZ_PASS(oz_renderer_create(&session->renderer, OZ_GL_AUTO, NULL));
        session->drawer = pthread_self();
    }
    return pthread_equal(session->drawer, pthread_self())
               ? OZ_OK
               : oz_status_fail(OZ_ERR_INPUT,
                                "%s: drawn from two threads; expected the one that drew first",
                                session->path);
}

OzStatus oz_session_draw_picture(OzSession *session, uint8_t *pixels)
{
    OZ_PASS(open_renderer(session));
    OZ_PASS(oz_session_see(session, oz_scene_shows_contacts(&session->scene)));
    if (!session->is_framed) {
        session->look = oz_renderer_look(&session->scene, &session->now);
        session->is_framed = true;
    }
    OzImage image = {.width = session->look.width, .height = session->look.height, pixels};
    return oz_renderer_draw(session->renderer, &session->now, &session->look, &image);
}
