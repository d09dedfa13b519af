/* The rows of the fluid that slows rods and spheres, a part of the table in rows.c, whose macros they are
 * written with. Read once, there. */
/* clang-format off: a row is a sentence of two or three lines. */
    {"drag.viscosity", NUMBER(0, 1e9, "Pa s"), AT(drag.viscosity), DEFAULT("0"), SOLID,
     .help = "of a fluid: Stokes' drag and torque on the sphere of each grain's volume"},
    {"drag.coefficient", NUMBER(0, 1e6, ""), AT(drag.coefficient), DEFAULT("0"), SOLID,
     .help = "drag over half the fluid's density, speed squared and that sphere's cross-section"},
    {"drag.density", NUMBER(0, 1e6, "kg/m^3"), AT(drag.density), DEFAULT("1.2"), SOLID,
     .help = "of the fluid, for the coefficient; grains do not float in it"},
    {"drag.wind", VECTOR(1e6, "m/s"), AT(drag.wind), DEFAULT("[0, 0, 0]"), SOLID,
     .help = "the fluid's velocity"},
/* clang-format on */
