/* liborzo's calls that read a state into the caller's arrays. */
#include "library/orzo_private.h"

#include <string.h>

int64_t orzo_count(const OrzoSim *sim)
{
    return sim->session.is_started ? sim->session.now.count : 0;
}

#define WIDTH(NAME, name, width, unit) [ORZO_##NAME] = width,
static const int widths[] = {ORZO_FIELDS(WIDTH)};
#undef WIDTH

/* What of a state does not change is the grains'. */
static const double *values_of(const OzSession *session, OrzoField field)
{
    const OzSnapshot *now = &session->now;
    const double *const values[] = {[ORZO_POSITION] = now->position,
                                    [ORZO_AXIS] = now->axis,
                                    [ORZO_QUATERNION] = now->quaternion,
                                    [ORZO_VELOCITY] = now->velocity,
                                    [ORZO_ANGULAR_VELOCITY] = now->angular_velocity,
                                    [ORZO_DIAMETER] = now->grains->diameter,
                                    [ORZO_LENGTH] = now->grains->length,
                                    [ORZO_MASS] = now->grains->mass};
    _Static_assert(sizeof values / sizeof *values == ORZO_FIELD_COUNT, "a row a field");
    return values[field];
}

static OzStatus read_field(OzSession *session, OrzoField field, double *values, int64_t room)
{
    if ((int)field < 0 || field >= ORZO_FIELD_COUNT) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: there is no field %d; expected 0 to %d",
                              session->path, (int)field, ORZO_FIELD_COUNT - 1);
    }
    OZ_PASS(oz_session_see(session, false));
    int64_t count = widths[field] * session->now.count;
    if (room != count) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s: room for %lld numbers; expected %d for each of %lld grains",
            session->path, (long long)room, widths[field], (long long)session->now.count);
    }
    if (count > 0) {
        memcpy(values, values_of(session, field), (size_t)count * sizeof *values);
    }
    return OZ_OK;
}

OrzoStatus orzo_read(OrzoSim *sim, OrzoField field, double *values, int64_t room)
{
    ORZO_STARTED(sim, read_field(&sim->session, field, values, room));
}

static OzStatus read_contacts(OzSession *session, OrzoContact *contacts, int64_t room,
                              int64_t *count)
{
    OZ_PASS(oz_session_see(session, true));
    const OzContactList *list = &session->now.contacts;
    *count = list->count;
    for (int64_t k = 0; k < list->count && k < room; k++) {
        const OzContactEntry *from = &list->entry[k];
        OrzoContact *to = &contacts[k];
        *to =
            (OrzoContact){.a = from->a, .b = from->b, .push = from->push, .overlap = from->overlap};
        memcpy(to->point, from->point, sizeof to->point);
        memcpy(to->normal, from->normal, sizeof to->normal);
        memcpy(to->tangential, from->tangential, sizeof to->tangential);
    }
    return OZ_OK;
}

OrzoStatus orzo_contacts(OrzoSim *sim, OrzoContact *contacts, int64_t room, int64_t *count)
{
    ORZO_STARTED(sim, read_contacts(&sim->session, contacts, room, count));
}

/* Starts it: what a scene has is known then. */
static OzStatus count_columns(const OzSession *session, int *count)
{
    const double *cells = NULL;
    *count = oz_series_row(session->series, &cells);
    return OZ_OK;
}

static OrzoStatus ask_columns(OrzoSim *sim, int *count)
{
    ORZO_STARTED(sim, count_columns(&sim->session, count));
}

int orzo_column_count(OrzoSim *sim)
{
    int count = 0;
    return ask_columns(sim, &count) == ORZO_OK ? count : 0;
}

const char *orzo_column(OrzoSim *sim, int column)
{
    OzSession *session = &sim->session;
    if (column < 0 || column >= orzo_column_count(sim)) {
        return NULL;
    }
    oz_series_name(session->series, column, session->column);
    return session->column;
}

static OzStatus observe(OzSession *session, const char *column, double *value)
{
    char name[OZ_COLUMN_NAME];
    OZ_PASS(oz_session_observe(session));
    for (int64_t k = 0; k < session->row_count; k++) {
        oz_series_name(session->series, (int)k, name);
        if (strcmp(name, column) == 0) {
            *value = session->row[k];
            return OZ_OK;
        }
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: there is no column %s; expected one of series.csv that this scene "
                          "has (orzo keys --columns)",
                          session->path, column);
}

OrzoStatus orzo_observe(OrzoSim *sim, const char *column, double *value)
{
    ORZO_STARTED(sim, observe(&sim->session, column, value));
}

static OzStatus observe_all(OzSession *session, double *values, int room)
{
    OZ_PASS(oz_session_observe(session));
    if (room != session->row_count) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: room for %d columns; expected %lld", session->path,
                              room, (long long)session->row_count);
    }
    memcpy(values, session->row, (size_t)room * sizeof *values);
    return OZ_OK;
}

OrzoStatus orzo_observe_all(OrzoSim *sim, double *values, int room)
{
    ORZO_STARTED(sim, observe_all(&sim->session, values, room));
}

static OzStatus read_wall(OzSession *session, int wall, double *offset, double *velocity)
{
    if (wall < 0 || wall >= session->scene.wall_count) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: there is no wall %d; expected 0 to %d",
                              session->path, wall, session->scene.wall_count - 1);
    }
    OZ_PASS(oz_session_see(session, false));
    *offset = session->now.wall_offset[wall];
    *velocity = session->now.wall_velocity[wall];
    return OZ_OK;
}

OrzoStatus orzo_wall(OrzoSim *sim, int wall, double *offset, double *velocity)
{
    ORZO_STARTED(sim, read_wall(&sim->session, wall, offset, velocity));
}
