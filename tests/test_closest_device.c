/* Closest points of two shafts in single precision, as a device computes them with 1 and with 16
 * lanes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "compute/program.h"
#include "shafts.h"

#include <stdlib.h>

enum { IN = 9, OUT = 2 };

static OzDevice device;

/* Where word k of item i lies: blocks of lanes, word by word. */
static size_t place(size_t i, size_t k, size_t words, size_t lanes)
{
    return ((i / lanes) * words + k) * lanes + i % lanes;
}

/* Fills pairs with what the device sees: centre 1 at the origin, everything rounded. */
static void write_pairs(OzCapsule (*pairs)[2], float *in, size_t lanes)
{
    for (size_t i = 0; i < SHAFT_PAIRS; i++) {
        OzCapsule *pair = pairs[i];
        make_pair(pair, (int)i);
        for (size_t c = 0; c < 3; c++) {
            float apart = (float)(pair[0].centre[c] - pair[1].centre[c]);
            float a = (float)pair[0].half_shaft[c], b = (float)pair[1].half_shaft[c];
            in[place(i, c, IN, lanes)] = apart;
            in[place(i, c + 3, IN, lanes)] = a;
            in[place(i, c + 6, IN, lanes)] = b;
            pair[0].centre[c] = apart;
            pair[1].centre[c] = 0;
            pair[0].half_shaft[c] = a;
            pair[1].half_shaft[c] = b;
        }
    }
}

static void run_kernel(cl_kernel kernel, float *in, float *out, size_t lanes)
{
    cl_int code;
    size_t blocks = SHAFT_PAIRS / lanes;
    size_t in_size = SHAFT_PAIRS * IN * sizeof *in, out_size = SHAFT_PAIRS * OUT * sizeof *out;
    cl_mem from = clCreateBuffer(device.context, CL_MEM_COPY_HOST_PTR, in_size, in, &code);
    assert_int_equal(code, CL_SUCCESS);
    cl_mem to = clCreateBuffer(device.context, CL_MEM_WRITE_ONLY, out_size, NULL, &code);
    assert_int_equal(code, CL_SUCCESS);
    clSetKernelArg(kernel, 0, sizeof from, &from);
    clSetKernelArg(kernel, 1, sizeof to, &to);
    code = clEnqueueNDRangeKernel(device.queue, kernel, 1, NULL, &blocks, NULL, 0, NULL, NULL);
    assert_int_equal(code, CL_SUCCESS);
    code = clEnqueueReadBuffer(device.queue, to, CL_TRUE, 0, out_size, out, 0, NULL, NULL);
    assert_int_equal(code, CL_SUCCESS);
    clReleaseMemObject(from);
    clReleaseMemObject(to);
}

/* Rounding of coordinates up to 5 is 3e-7 each, several times over. */
static void check_distances(OzCapsule (*pairs)[2], const float *out, size_t lanes)
{
    for (size_t i = 0; i < SHAFT_PAIRS; i++) {
        double s = out[place(i, 0, OUT, lanes)], t = out[place(i, 1, OUT, lanes)];
        assert_true(s >= -1 && s <= 1 && t >= -1 && t <= 1);
        double excess =
            distance_between(pairs[i], s, t) - brute_distance(&pairs[i][0], &pairs[i][1]);
        if (!(fabs(excess) < allowed_excess(pairs[i], 2e-6, 1e-5))) {
            fail_msg("pair %zu, %zu lanes: %g too far", i, lanes, excess);
        }
    }
}

static void check_lanes(size_t lanes)
{
    char options[64];
    cl_program program;
    cl_int code;
    OzCapsule(*pairs)[2] = calloc(SHAFT_PAIRS, sizeof *pairs);
    float *in = calloc(SHAFT_PAIRS * IN, sizeof *in), *out = calloc(SHAFT_PAIRS * OUT, sizeof *out);
    assert_true(pairs && in && out);
    snprintf(options, sizeof options, "-DOZ_LANES=%zu", lanes);
    write_pairs(pairs, in, lanes);
    if (oz_program_build(&program, &device, ORZO_SOURCE, "tests/closest.cl", options) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    cl_kernel kernel = clCreateKernel(program, "closest", &code);
    assert_int_equal(code, CL_SUCCESS);
    run_kernel(kernel, in, out, lanes);
    check_distances(pairs, out, lanes);
    clReleaseKernel(kernel);
    clReleaseProgram(program);
    free(pairs);
    free(in);
    free(out);
}

static void test_one_lane(void **state)
{
    (void)state;
    check_lanes(1);
}

static void test_sixteen_lanes(void **state)
{
    (void)state;
    check_lanes(16);
}

int main(void)
{
    if (oz_device_open(&device, NULL, 0) != OZ_OK) {
        print_error("%s\n", oz_status_text());
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_lane),
        cmocka_unit_test(test_sixteen_lanes),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    oz_device_close(&device);
    return failed;
}
