/* `orzo --man`: the manual page, made of the lists that parsing, help, keys and columns come from.
 */
#pragma once

#include "base/status.h"

#include <stdio.h>

/* Writes orzo(1) in the language of man(7). Fails with OZ_ERR_MEMORY. */
OzStatus oz_manual_print(FILE *file);
