/* Writes .vtp and .vti files. */
#include "export/vtk_file.h"

#include <stdbool.h>

/* The arrays are named twice, in the XML and behind it: the same walk does both. */
typedef struct Walk {
    FILE *file;
    bool is_raw;     /* the bytes, else the XML             */
    uint64_t offset; /* of the next array behind the XML    */
} Walk;

static void visit(Walk *walk, const char *name, const char *type, int width, const void *data,
                  uint64_t bytes)
{
    if (walk->is_raw) {
        fwrite(&bytes, sizeof bytes, 1, walk->file);
        fwrite(data, 1, bytes, walk->file);
    } else {
        fprintf(walk->file,
                "<DataArray Name=\"%s\" type=\"%s\" NumberOfComponents=\"%d\" "
                "format=\"appended\" offset=\"%llu\"/>\n",
                name, type, width, (unsigned long long)walk->offset);
    }
    walk->offset += sizeof bytes + bytes;
}

static void open_section(const Walk *walk, const char *name)
{
    if (!walk->is_raw) {
        fprintf(walk->file, "<%s>\n", name);
    }
}

static void close_section(const Walk *walk, const char *name)
{
    if (!walk->is_raw) {
        fprintf(walk->file, "</%s>\n", name);
    }
}

static void visit_arrays(Walk *walk, const char *section, const OzVtkArray *arrays, int count,
                         int64_t rows)
{
    open_section(walk, section);
    for (int k = 0; k < count; k++) {
        visit(walk, arrays[k].name, "Float32", arrays[k].width, arrays[k].data,
              (uint64_t)rows * (uint64_t)arrays[k].width * sizeof(float));
    }
    close_section(walk, section);
}

static void visit_all(Walk *walk, const OzVtkFile *vtk)
{
    static const char *const sections[] = {
        [OZ_VTK_VERTICES] = "Verts", [OZ_VTK_LINES] = "Lines", [OZ_VTK_POLYGONS] = "Polys"};
    int64_t corners = vtk->cell_count > 0 ? vtk->ends[vtk->cell_count - 1] : 0;
    open_section(walk, "Points");
    visit(walk, "Points", "Float32", 3, vtk->points,
          (uint64_t)vtk->point_count * 3 * sizeof(float));
    close_section(walk, "Points");
    open_section(walk, sections[vtk->cells]);
    visit(walk, "connectivity", "Int64", 1, vtk->corners, (uint64_t)corners * sizeof(int64_t));
    visit(walk, "offsets", "Int64", 1, vtk->ends, (uint64_t)vtk->cell_count * sizeof(int64_t));
    close_section(walk, sections[vtk->cells]);
    visit_arrays(walk, "PointData", vtk->point_arrays, vtk->point_array_count, vtk->point_count);
    visit_arrays(walk, "CellData", vtk->cell_arrays, vtk->cell_array_count, vtk->cell_count);
}

static const char *byte_order(void)
{
    const uint16_t word = 1;
    return *(const unsigned char *)&word ? "LittleEndian" : "BigEndian";
}

/* The head; attributes: of the kind's own element. */
static void begin(FILE *file, const char *kind, const char *attributes, double time)
{
    fprintf(file,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"%s\" version=\"1.0\" byte_order=\"%s\" "
            "header_type=\"UInt64\">\n<%s%s>\n",
            kind, byte_order(), kind, attributes);
    fprintf(file,
            "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
            "format=\"ascii\">%.17g</DataArray></FieldData>\n",
            time);
}

void oz_vtk_file_write(const OzVtkFile *vtk, FILE *file)
{
    static const char *const counts[] = {[OZ_VTK_VERTICES] = "NumberOfVerts",
                                         [OZ_VTK_LINES] = "NumberOfLines",
                                         [OZ_VTK_POLYGONS] = "NumberOfPolys"};
    Walk xml = {.file = file}, raw = {.file = file, .is_raw = true};
    begin(file, "PolyData", "", vtk->time);
    fprintf(file, "<Piece NumberOfPoints=\"%lld\" %s=\"%lld\">\n", (long long)vtk->point_count,
            counts[vtk->cells], (long long)vtk->cell_count);
    visit_all(&xml, vtk);
    fputs("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_", file);
    visit_all(&raw, vtk);
    fputs("\n</AppendedData>\n</VTKFile>\n", file);
}

void oz_vtk_file_write_image(const OzVtkImage *image, FILE *file)
{
    Walk xml = {.file = file}, raw = {.file = file, .is_raw = true};
    const double *low = image->low, *edge = image->edge;
    long long x = image->cells[0], y = image->cells[1], z = image->cells[2];
    char attributes[256];
    snprintf(attributes, sizeof attributes,
             " WholeExtent=\"0 %lld 0 %lld 0 %lld\" Origin=\"%.17g %.17g %.17g\" "
             "Spacing=\"%.17g %.17g %.17g\"",
             x, y, z, low[0], low[1], low[2], edge[0], edge[1], edge[2]);
    begin(file, "ImageData", attributes, image->time);
    fprintf(file, "<Piece Extent=\"0 %lld 0 %lld 0 %lld\">\n", x, y, z);
    visit_arrays(&xml, "CellData", image->arrays, image->array_count, x * y * z);
    fputs("</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_", file);
    visit_arrays(&raw, "CellData", image->arrays, image->array_count, x * y * z);
    fputs("\n</AppendedData>\n</VTKFile>\n", file);
}
