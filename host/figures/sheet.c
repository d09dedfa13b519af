/* Laying single pictures out, pixel by pixel. */
#include "figures/sheet.h"

#include "base/folder.h"
#include "base/memory.h"
#include "figures/sheet_pictures.h"

#include <stdlib.h>
#include <string.h>

/* Pixels: of the line above a picture, of a row's name, of the title and of the caption. */
enum { LINE = 24, SIDE = 34, TITLE = 36, CAPTION = 28, WIDTH = 480, HEIGHT = 480 };

typedef struct Sheet {
    const OzFigureWork *work;
    OzSheetRow *rows;
    int row_count, across;             /* most pictures of a row    */
    int picture_width, picture_height; /* pixels                 */
    int width, height;                 /* of all                    */
} Sheet;

/* A row for each run and each of its views. */
static OzStatus make_rows(Sheet *sheet)
{
    const OzStudyFigure *figure = sheet->work->figure;
    int views = figure->views.count ? figure->views.count : 1;
    OZ_PASS(OZ_NEW(&sheet->rows, figure->runs.count * views));
    for (int i = 0; i < figure->runs.count * views; i++) {
        OzSheetRow *row = &sheet->rows[sheet->row_count++];
        row->run = oz_figure_work_run(sheet->work, figure->runs.items[i / views]);
        row->view = figure->views.count ? figure->views.items[i % views] : NULL;
        OZ_PASS(oz_sheet_pictures_draw(sheet->work, row));
        sheet->across = row->files.count > sheet->across ? row->files.count : sheet->across;
    }
    return OZ_OK;
}

static void measure(Sheet *sheet)
{
    const OzNumbers *size = &sheet->work->figure->size;
    sheet->picture_width = size->count ? (int)size->items[0] : WIDTH;
    sheet->picture_height = size->count ? (int)size->items[1] : HEIGHT;
    sheet->width = SIDE + sheet->across * sheet->picture_width;
    sheet->height = TITLE + CAPTION + sheet->row_count * (LINE + sheet->picture_height);
}

static OzStatus write_table(const Sheet *sheet)
{
    OzStatus status = OZ_OK;
    FILE *file = NULL;
    char *name = NULL, moment[64];
    if (asprintf(&name, "%s.csv", sheet->work->figure->name) < 0) {
        name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a name");
    }
    OZ_TRY(oz_folder_create_file(&file, sheet->work->folder, name));
    fputs("run,member,view,moment,picture\n", file);
    for (int r = 0; r < sheet->row_count; r++) {
        const OzSheetRow *row = &sheet->rows[r];
        for (int i = 0; i < row->files.count; i++) {
            oz_sheet_pictures_say(row->files.items[i], moment, sizeof moment);
            fprintf(file, "%s,%s,%s,%s,%s\n", row->run->name, row->member,
                    row->view ? row->view : "", moment,
                    row->files.items[i] + strlen(sheet->work->folder) + 1);
        }
    }
done:
    OZ_AFTER(status, oz_folder_finish_file(file, name));
    free(name);
    return status;
}

/* A text at a place in pixels from the left and the top. */
static void send_text(const Sheet *sheet, FILE *gnuplot, const char *text, double x, double y,
                      const char *how)
{
    fputs("set label ", gnuplot);
    oz_figure_work_text(gnuplot, text);
    fprintf(gnuplot, " at screen %.6f,%.6f center %s\n", x / sheet->width, 1 - y / sheet->height,
            how);
}

static void send_words(const Sheet *sheet, FILE *gnuplot)
{
    const OzStudyFigure *figure = sheet->work->figure;
    char text[256];
    send_text(sheet, gnuplot, figure->title ? figure->title : figure->name, 0.5 * sheet->width,
              0.5 * TITLE, "");
    snprintf(text, sizeof text, "; shown: %s", sheet->rows[0].member);
    oz_figure_work_send_caption(sheet->work, gnuplot,
                                strstr(sheet->work->caption, "seeds") ? text : "");
    for (int r = 0; r < sheet->row_count; r++) {
        const OzSheetRow *row = &sheet->rows[r];
        double top = TITLE + r * (LINE + sheet->picture_height);
        snprintf(text, sizeof text, "%s%s%s", row->run->label ? row->run->label : row->run->name,
                 row->view ? ", " : "", row->view ? row->view : "");
        send_text(sheet, gnuplot, text, 0.5 * SIDE, top + LINE + 0.5 * sheet->picture_height,
                  "rotate by 90 font ',10'");
        for (int i = 0; i < row->files.count; i++) {
            oz_sheet_pictures_say(row->files.items[i], text, sizeof text);
            send_text(sheet, gnuplot, text, SIDE + (i + 0.5) * sheet->picture_width,
                      top + 0.5 * LINE, "font ',10'");
        }
    }
}

static void send_picture(const Sheet *sheet, FILE *gnuplot, int r, int i)
{
    double left = SIDE + i * sheet->picture_width;
    double top = TITLE + LINE + r * (LINE + sheet->picture_height);
    fprintf(gnuplot,
            "set lmargin at screen %.8f\nset rmargin at screen %.8f\nset tmargin at screen %.8f\n"
            "set bmargin at screen %.8f\nplot ",
            left / sheet->width, (left + sheet->picture_width) / sheet->width,
            1 - top / sheet->height, 1 - (top + sheet->picture_height) / sheet->height);
    oz_figure_work_text(gnuplot, sheet->rows[r].files.items[i]);
    fputs(" binary filetype=png with rgbimage notitle\n", gnuplot);
}

static OzStatus draw(const Sheet *sheet)
{
    FILE *gnuplot = NULL;
    OZ_PASS(oz_figure_work_open(sheet->work, "png", sheet->width, sheet->height, &gnuplot));
    if (gnuplot) {
        fputs("set multiplot\nunset border\nunset tics\nset autoscale fix\n", gnuplot);
        send_words(sheet, gnuplot);
        for (int r = 0; r < sheet->row_count; r++) {
            for (int i = 0; i < sheet->rows[r].files.count; i++) {
                send_picture(sheet, gnuplot, r, i);
                fputs("unset label\n", gnuplot); /* once is enough */
            }
        }
        fputs("unset multiplot\n", gnuplot);
    }
    return oz_figure_work_close(sheet->work, "png", gnuplot);
}

OzStatus oz_sheet_draw(const OzFigureWork *work)
{
    OzStatus status = OZ_OK;
    Sheet sheet = {.work = work};
    OZ_TRY(make_rows(&sheet));
    measure(&sheet);
    OZ_TRY(write_table(&sheet));
    OZ_TRY(draw(&sheet));
done:
    for (int r = 0; r < sheet.row_count; r++) {
        oz_sheet_pictures_free(&sheet.rows[r]);
    }
    free(sheet.rows);
    return status;
}
