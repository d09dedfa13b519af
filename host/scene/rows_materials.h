/* The rows of materials, a part of the table in rows.c, whose macros they are written with. Read once,
 * there. */
#define OF_MATERIAL(name, spec, help_)                                                             \
    {                                                                                              \
        "materials[]." #name, spec, MATERIAL(contact.name), .inherits = "contact." #name, SOLID,   \
                                                            .help = help_                          \
    }
#define OF_PAIR(name, spec, help_)                                                                 \
    {                                                                                              \
        "pairs[]." #name, spec, .offset = offsetof(OzMaterialPair, contact.name),                  \
                                .count_offset = offsetof(OzMaterialPair, has_##name),              \
                                .write = OZ_WRITE_MARKED, .fallback_help = "mixed", SOLID,         \
                                .help = help_                                                      \
    }
/* clang-format off: a row is a sentence of two or three lines. */
    {"materials", OF(ITEMS), AT(materials), .count_offset = offsetof(OzScene, material_count),
     .item_size = sizeof(OzMaterial), .line_offset = offsetof(OzMaterial, line), SOLID,
     FIXED("grains are made of them"), .fallback_help = "none",
     .help = "that grains and walls name; two that meet are mixed by the rules of the manual"},
    {"materials[].name", OF(TEXT), MATERIAL(name), REQUIRED, .write = OZ_WRITE_NONZERO, SOLID,
     FIXED("grains are made of them"), .help = "by which grains, walls and pairs know it"},
    {"materials[].density", NUMBER(1e-6, 1e9, "kg/m^3"), MATERIAL(density), DEFAULT("2500"), SOLID,
     GRAINS_MADE, .help = "of its grains"},
    OF_MATERIAL(contact_time, CONTACT_TIME, "duration of a free hit with its like (hooke)"),
    OF_MATERIAL(restitution, FRACTION, "speed after over speed before, with its like"),
    OF_MATERIAL(youngs_modulus, MODULUS, "hertz-mindlin"),
    OF_MATERIAL(poisson_ratio, POISSON, "hertz-mindlin"),
    OF_MATERIAL(hertz_stiffness, NUMBER(1e-12, 1e30, "N/m^1.5"), "with its like (hertz)"),
    OF_MATERIAL(normal_damping_rate, DAMPING_RATE, "with its like (hertz)"),
    OF_MATERIAL(tangential_damping_rate, DAMPING_RATE, "with its like (hertz)"),
    OF_MATERIAL(friction, COEFFICIENT, "Coulomb's coefficient, with its like"),
    OF_MATERIAL(tangential_stiffness, RATIO, "tangential over normal stiffness"),
    OF_MATERIAL(tangential_damping, RATIO, "tangential over normal damping"),
    OF_MATERIAL(surface_energy, NUMBER(0, 1e9, "J/m^2"), "work of adhesion, with its like"),
    OF_MATERIAL(rolling_friction, COEFFICIENT, "couple over normal force and radius"),
    OF_MATERIAL(rolling_damping, RATIO, "of the rolling spring, over critical"),
    OF_MATERIAL(twisting_friction, COEFFICIENT, "the same about the normal"),
    {"pairs", OF(ITEMS), AT(pairs), .count_offset = offsetof(OzScene, pair_count),
     .item_size = sizeof(OzMaterialPair), .line_offset = offsetof(OzMaterialPair, line), SOLID,
     FIXED("a pair that is listed can change"), .fallback_help = "all are mixed",
     .help = "what two materials do to each other where it is known"},
    {"pairs[].between", .type = OZ_KEY_NAMES, .width = 2, .unit = "",
     .offset = offsetof(OzMaterialPair, between), REQUIRED, SOLID,
     FIXED("a pair that is listed can change"), .help = "two names of materials, or one twice"},
    OF_PAIR(contact_time, CONTACT_TIME, "duration of a free hit (hooke)"),
    OF_PAIR(restitution, FRACTION, "speed after over speed before"),
    OF_PAIR(hertz_stiffness, NUMBER(1e-12, 1e30, "N/m^1.5"), "force over overlap^1.5 (hertz)"),
    OF_PAIR(normal_damping_rate, DAMPING_RATE, "damping over mass and rate (hertz)"),
    OF_PAIR(tangential_damping_rate, DAMPING_RATE, "the same for sliding (hertz)"),
    OF_PAIR(friction, COEFFICIENT, "Coulomb's coefficient"),
    OF_PAIR(tangential_stiffness, RATIO, "tangential over normal stiffness"),
    OF_PAIR(tangential_damping, RATIO, "tangential over normal damping"),
    OF_PAIR(surface_energy, NUMBER(0, 1e9, "J/m^2"), "work of adhesion"),
    OF_PAIR(rolling_friction, COEFFICIENT, "couple over normal force and radius"),
    OF_PAIR(rolling_damping, RATIO, "of the rolling spring, over critical"),
    OF_PAIR(twisting_friction, COEFFICIENT, "the same about the normal"),
/* clang-format on */
