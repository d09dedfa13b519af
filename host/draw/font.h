/* Text on pictures, through FreeType. Without a font, text is left out, never an error. */
#pragma once

#include "draw/image.h"

#include <ft2build.h>
#include FT_FREETYPE_H

typedef enum OzWeight { OZ_WEIGHT_REGULAR, OZ_WEIGHT_BOLD, OZ_WEIGHT_COUNT } OzWeight;

typedef struct OzFont {
    FT_Library library;
    FT_Face faces[OZ_WEIGHT_COUNT]; /* NULL: text is left out */
} OzFont;

/* Opens DejaVu Sans, or another plain font, from the usual folders; when there is none, one log
 * line says so. */
void oz_font_open(OzFont *font);
void oz_font_close(OzFont *font); /* zeroed is fine */

/* Width of a UTF-8 text in pixels; size is pixels per em. */
double oz_font_width(const OzFont *font, OzWeight weight, double size, const char *text);

/* Bytes of the longest beginning of the text, whole characters, that is no wider than width. */
size_t oz_font_fit(const OzFont *font, OzWeight weight, double size, const char *text,
                   double width);

/* Draws the text from x on, with its baseline at y (pixels from the top left); what falls outside
 * the image is left out. */
void oz_font_draw(const OzFont *font, OzImage *image, OzWeight weight, double size, double x,
                  double y, const float rgb[3], const char *text);
