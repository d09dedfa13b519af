/* Off-screen contexts through EGL and OSMesa, both opened with dlopen. The only file that knows
 * these two libraries; it draws nothing. */
#include "draw/context.h"

#include "base/log.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* OSMesa's own header is a package more; these few lines of it are its stable interface. */
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
    OSMESA_SIDE = 16 /* pixels of the surface that is never drawn on */
};

static const char *const ADVICE =
    "install libegl1 and libgl1-mesa-dri (EGL) or libosmesa6 (OSMesa), or run with --no-video";

/* The libraries' entry points, filled in by the first context of each kind. */
static struct {
    void *library;
    __typeof__(eglGetProcAddress) *get_proc_address;
    __typeof__(eglInitialize) *initialize;
    __typeof__(eglBindAPI) *bind_api;
    __typeof__(eglQueryString) *query_string;
    __typeof__(eglChooseConfig) *choose_config;
    __typeof__(eglCreateContext) *create_context;
    __typeof__(eglMakeCurrent) *make_current;
    __typeof__(eglDestroyContext) *destroy_context;
    __typeof__(eglGetError) *get_error;
} egl;

static struct {
    void *library;
    void *(*create_context)(const int *attributes, void *shared);
    unsigned char (*make_current)(void *context, void *pixels, unsigned type, int width,
                                  int height);
    void (*destroy_context)(void *context);
    OzGlFunction (*get_proc_address)(const char *name);
} osmesa;

static OzStatus open_library(void **library, const char *const *names)
{
    char reason[512] = "";
    for (; *names && !*library; names++) {
        *library = dlopen(*names, RTLD_NOW | RTLD_LOCAL);
        if (!*library) {
            snprintf(reason, sizeof reason, "%s", dlerror());
        }
    }
    return *library ? OZ_OK : oz_status_fail(OZ_ERR_GRAPHICS, "cannot open it: %s", reason);
}

static OzStatus find_symbol(void *slot, void *library, const char *name)
{
    void *symbol = dlsym(library, name);
    if (!symbol) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "the library has no %s", name);
    }
    memcpy(slot, &symbol, sizeof symbol);
    return OZ_OK;
}

static OzStatus open_egl(void)
{
    OZ_PASS(open_library(&egl.library, (const char *const[]){"libEGL.so.1", "libEGL.so", NULL}));
    OZ_PASS(find_symbol(&egl.get_proc_address, egl.library, "eglGetProcAddress"));
    OZ_PASS(find_symbol(&egl.initialize, egl.library, "eglInitialize"));
    OZ_PASS(find_symbol(&egl.bind_api, egl.library, "eglBindAPI"));
    OZ_PASS(find_symbol(&egl.query_string, egl.library, "eglQueryString"));
    OZ_PASS(find_symbol(&egl.choose_config, egl.library, "eglChooseConfig"));
    OZ_PASS(find_symbol(&egl.create_context, egl.library, "eglCreateContext"));
    OZ_PASS(find_symbol(&egl.make_current, egl.library, "eglMakeCurrent"));
    OZ_PASS(find_symbol(&egl.destroy_context, egl.library, "eglDestroyContext"));
    return find_symbol(&egl.get_error, egl.library, "eglGetError");
}

static OzStatus open_osmesa(void)
{
    OZ_PASS(open_library(&osmesa.library,
                         (const char *const[]){"libOSMesa.so.8", "libOSMesa.so.6", NULL}));
    OZ_PASS(find_symbol(&osmesa.create_context, osmesa.library, "OSMesaCreateContextAttribs"));
    OZ_PASS(find_symbol(&osmesa.make_current, osmesa.library, "OSMesaMakeCurrent"));
    OZ_PASS(find_symbol(&osmesa.destroy_context, osmesa.library, "OSMesaDestroyContext"));
    return find_symbol(&osmesa.get_proc_address, osmesa.library, "OSMesaGetProcAddress");
}

static const char *egl_error_name(EGLint code)
{
    static const char *const names[] = {
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE"};
    int row = code - EGL_SUCCESS;
    return row >= 0 && row < (int)(sizeof names / sizeof *names) ? names[row] : "an unknown code";
}

static OzStatus egl_failed(const char *call)
{
    EGLint code = egl.get_error();
    return oz_status_fail(OZ_ERR_GRAPHICS, "%s failed with %s (0x%x)", call, egl_error_name(code),
                          (unsigned)code);
}

/* As OZ_PASS, for an EGL call that may be refused. */
#define EGL_PASS(call, name) OZ_PASS((call) ? OZ_OK : egl_failed(name))

/* The first EGL device whose display can be initialised: the way to NVIDIA's driver. */
static EGLDisplay device_display(PFNEGLGETPLATFORMDISPLAYEXTPROC get_display)
{
    enum { DEVICES = 16 };
    PFNEGLQUERYDEVICESEXTPROC query =
        (PFNEGLQUERYDEVICESEXTPROC)egl.get_proc_address("eglQueryDevicesEXT");
    EGLDeviceEXT devices[DEVICES];
    EGLint count = 0;
    if (!query || !query(DEVICES, devices, &count)) {
        return EGL_NO_DISPLAY;
    }
    for (EGLint i = 0; i < count; i++) {
        EGLDisplay display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
        if (display != EGL_NO_DISPLAY && egl.initialize(display, NULL, NULL)) {
            return display;
        }
    }
    return EGL_NO_DISPLAY;
}

static OzStatus find_display(OzContext *context, const char **platform)
{
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)egl.get_proc_address("eglGetPlatformDisplayEXT");
    const char *extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!get_display || !extensions) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "this EGL has no eglGetPlatformDisplayEXT");
    }
    if (strstr(extensions, "EGL_MESA_platform_surfaceless")) {
        *platform = "surfaceless";
        context->display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
        if (context->display && egl.initialize(context->display, NULL, NULL)) {
            return OZ_OK;
        }
        oz_log_line("graphics: EGL surfaceless refused: %s", egl_error_name(egl.get_error()));
    }
    *platform = "device";
    context->display = device_display(get_display);
    return context->display
               ? OZ_OK
               : oz_status_fail(OZ_ERR_GRAPHICS,
                                "neither the surfaceless nor the device platform works");
}

static OzStatus create_egl(OzContext *context)
{
    const char *platform = "";
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    EGLConfig config = NULL;
    EGLint config_count = 0;
    OZ_PASS(open_egl());
    OZ_PASS(find_display(context, &platform));
    EGL_PASS(egl.bind_api(EGL_OPENGL_API), "eglBindAPI");
    EGL_PASS(egl.choose_config(context->display, wanted, &config, 1, &config_count),
             "eglChooseConfig");
    context->handle =
        egl.create_context(context->display, config_count ? config : NULL, EGL_NO_CONTEXT, version);
    EGL_PASS(context->handle, "eglCreateContext (OpenGL 3.3 core)");
    OZ_PASS(oz_context_use(context));
    OZ_PASS(oz_gl_load(&context->gl, (OzGlFinder)egl.get_proc_address));
    snprintf(context->name, sizeof context->name, "EGL %s", platform);
    return OZ_OK;
}

static OzStatus create_osmesa(OzContext *context)
{
    const int wanted[] = {OSMESA_FORMAT,
                          GL_RGBA,
                          OSMESA_PROFILE,
                          OSMESA_CORE_PROFILE,
                          OSMESA_CONTEXT_MAJOR_VERSION,
                          3,
                          OSMESA_CONTEXT_MINOR_VERSION,
                          3,
                          0};
    OZ_PASS(open_osmesa());
    context->pixels = calloc(OSMESA_SIDE, 4 * OSMESA_SIDE);
    if (!context->pixels) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for an OSMesa surface");
    }
    context->handle = osmesa.create_context(wanted, NULL);
    if (!context->handle) {
        return oz_status_fail(OZ_ERR_GRAPHICS, "no OpenGL 3.3 core context to be had");
    }
    OZ_PASS(oz_context_use(context));
    OZ_PASS(oz_gl_load(&context->gl, osmesa.get_proc_address));
    snprintf(context->name, sizeof context->name, "OSMesa");
    return OZ_OK;
}

OzStatus oz_context_use(const OzContext *context)
{
    if (!context->display) {
        return osmesa.make_current(context->handle, context->pixels, GL_UNSIGNED_BYTE, OSMESA_SIDE,
                                   OSMESA_SIDE)
                   ? OZ_OK
                   : oz_status_fail(OZ_ERR_GRAPHICS, "OSMesaMakeCurrent failed");
    }
    return egl.make_current(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->handle)
               ? OZ_OK
               : egl_failed("eglMakeCurrent without a surface");
}

static void complete_name(OzContext *context)
{
    size_t used = strlen(context->name);
    snprintf(context->name + used, sizeof context->name - used, ", OpenGL %s, %s",
             (const char *)context->gl.GetString(GL_VERSION),
             (const char *)context->gl.GetString(GL_RENDERER));
}

static OzStatus try_backend(OzContext *context, OzGlBackend backend)
{
    memset(context, 0, sizeof *context);
    OzStatus status = backend == OZ_GL_EGL ? create_egl(context) : create_osmesa(context);
    if (status == OZ_OK) {
        complete_name(context);
    } else {
        oz_context_free(context);
    }
    return status;
}

OzStatus oz_context_create(OzContext *context, OzGlBackend backend)
{
    char first[512] = "";
    const char *name = backend == OZ_GL_EGL ? "EGL" : "OSMesa";
    if (backend == OZ_GL_AUTO) {
        if (try_backend(context, OZ_GL_EGL) == OZ_OK) {
            return OZ_OK;
        }
        oz_log_line("graphics: EGL refused: %s", oz_status_text());
        snprintf(first, sizeof first, "EGL: %s; ", oz_status_text());
        backend = OZ_GL_OSMESA;
    }
    OzStatus status = try_backend(context, backend);
    if (status != OZ_OK) {
        char reason[512];
        snprintf(reason, sizeof reason, "%s", oz_status_text());
        oz_log_line("graphics: %s refused: %s", name, reason);
        oz_status_fail(status, "no off-screen OpenGL 3.3: %s%s: %s; %s", first, name, reason,
                       ADVICE);
    }
    return status;
}

void oz_context_free(OzContext *context)
{
    if (context->handle && context->display) {
        egl.make_current(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl.destroy_context(context->display, context->handle);
    } else if (context->handle) {
        osmesa.destroy_context(context->handle);
    }
    free(context->pixels);
    memset(context, 0, sizeof *context);
}

static void describe_here(FILE *file, OzGlBackend backend, const char *name)
{
    OzContext context;
    if (try_backend(&context, backend) == OZ_OK) {
        fprintf(file, "  %s\n", context.name);
    } else {
        fprintf(file, "  %s refused: %s\n", name, oz_status_text());
    }
    fflush(file);
}

void oz_context_describe(FILE *file)
{
    static const OzGlBackend backends[] = {OZ_GL_EGL, OZ_GL_OSMESA};
    static const char *const names[] = {"EGL", "OSMesa"};
    for (int i = 0; i < 2; i++) {
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) {
            describe_here(file, backends[i], names[i]);
            _exit(0);
        }
        int outcome = -1;
        if (child < 0 || waitpid(child, &outcome, 0) < 0 || outcome != 0) {
            fprintf(file, "  %s refused: its driver did not survive the attempt\n", names[i]);
        }
    }
}
