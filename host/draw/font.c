/* Finding a font and setting text. Knows nothing of what the text says. */
#include "draw/font.h"

#include "base/file.h"
#include "base/log.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where systems keep plain fonts: regular, then bold. */
static const char *const FONTS[][OZ_WEIGHT_COUNT] = {
    {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
     "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
     "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans-Bold.ttf"},
    {"/usr/local/share/fonts/dejavu/DejaVuSans.ttf",
     "/usr/local/share/fonts/dejavu/DejaVuSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
     "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
     "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"},
    {"/usr/share/fonts/noto/NotoSans-Regular.ttf", "/usr/share/fonts/noto/NotoSans-Bold.ttf"},
    {"/System/Library/Fonts/Supplemental/Arial.ttf",
     "/System/Library/Fonts/Supplemental/Arial Bold.ttf"}};

static bool open_faces(OzFont *font, const char *const paths[OZ_WEIGHT_COUNT])
{
    if (!oz_file_exists(paths[0]) || FT_New_Face(font->library, paths[0], 0, &font->faces[0])) {
        return false;
    }
    if (FT_New_Face(font->library, paths[1], 0, &font->faces[1])) {
        font->faces[1] = font->faces[0];
        FT_Reference_Face(font->faces[0]);
    }
    return true;
}

void oz_font_open(OzFont *font)
{
    memset(font, 0, sizeof *font);
    if (FT_Init_FreeType(&font->library)) {
        font->library = NULL;
        return;
    }
    for (size_t i = 0; i < sizeof FONTS / sizeof *FONTS && !font->faces[0]; i++) {
        open_faces(font, FONTS[i]);
    }
    if (!font->faces[0]) {
        oz_log_once("pictures carry no text: no font found; install fonts-dejavu-core");
    }
}

void oz_font_close(OzFont *font)
{
    for (int i = 0; i < OZ_WEIGHT_COUNT; i++) {
        if (font->faces[i]) {
            FT_Done_Face(font->faces[i]);
        }
    }
    if (font->library) {
        FT_Done_FreeType(font->library);
    }
    memset(font, 0, sizeof *font);
}

/* The next character of a UTF-8 text; broken bytes come as they are. */
static FT_ULong next_character(const char **text)
{
    const unsigned char *bytes = (const unsigned char *)*text;
    int more = bytes[0] >= 0xf0 ? 3 : bytes[0] >= 0xe0 ? 2 : bytes[0] >= 0xc0 ? 1 : 0;
    FT_ULong character = more ? bytes[0] & (0x3fu >> more) : bytes[0];
    for (int i = 1; i <= more; i++) {
        if ((bytes[i] & 0xc0) != 0x80) {
            *text += 1;
            return bytes[0];
        }
        character = character << 6 | (bytes[i] & 0x3f);
    }
    *text += 1 + more;
    return character;
}

static FT_Face face_of_size(const OzFont *font, OzWeight weight, double size)
{
    FT_Face face = font->faces[weight];
    if (face && FT_Set_Char_Size(face, 0, (FT_F26Dot6)lround(64 * size), 72, 72)) {
        return NULL;
    }
    return face;
}

/* The width of the next character, pixels; *text moves on to the one after. */
static double advance_over(FT_Face face, const char **text)
{
    FT_ULong character = next_character(text);
    return FT_Load_Char(face, character, FT_LOAD_NO_HINTING) == 0
               ? (double)face->glyph->linearHoriAdvance / 65536
               : 0;
}

double oz_font_width(const OzFont *font, OzWeight weight, double size, const char *text)
{
    FT_Face face = face_of_size(font, weight, size);
    double width = 0;
    while (face && *text) {
        width += advance_over(face, &text);
    }
    return width;
}

size_t oz_font_fit(const OzFont *font, OzWeight weight, double size, const char *text, double width)
{
    FT_Face face = face_of_size(font, weight, size);
    const char *end = text, *next = text;
    while (face && *next) {
        width -= advance_over(face, &next);
        if (width < 0) {
            break;
        }
        end = next;
    }
    return (size_t)(end - text);
}

static void blend(OzImage *image, int x, int y, const float rgb[3], double share)
{
    if (x < 0 || y < 0 || x >= image->width || y >= image->height) {
        return;
    }
    uint8_t *pixel = image->pixels + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
    for (int k = 0; k < 3; k++) {
        pixel[k] = (uint8_t)lround(pixel[k] + (255.0 * (double)rgb[k] - pixel[k]) * share);
    }
}

static void stamp(OzImage *image, const FT_Bitmap *bitmap, int left, int top, const float rgb[3])
{
    for (int y = 0; y < (int)bitmap->rows; y++) {
        for (int x = 0; x < (int)bitmap->width; x++) {
            int grey = bitmap->buffer[y * bitmap->pitch + x];
            if (grey) {
                blend(image, left + x, top + y, rgb, grey / 255.0);
            }
        }
    }
}

void oz_font_draw(const OzFont *font, OzImage *image, OzWeight weight, double size, double x,
                  double y, const float rgb[3], const char *text)
{
    FT_Face face = face_of_size(font, weight, size);
    while (face && *text) {
        /* The fraction of a pixel goes into the glyph, so that letters stand evenly. */
        FT_Vector shift = {lround(64 * (x - floor(x))), 0};
        FT_Set_Transform(face, NULL, &shift);
        FT_ULong character = next_character(&text);
        if (FT_Load_Char(face, character, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0) {
            stamp(image, &face->glyph->bitmap, (int)floor(x) + face->glyph->bitmap_left,
                  (int)lround(y) - face->glyph->bitmap_top, rgb);
            x += (double)face->glyph->linearHoriAdvance / 65536;
        }
    }
    if (face) {
        FT_Set_Transform(face, NULL, NULL);
    }
}
