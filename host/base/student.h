/* Student's t, for intervals of confidence from few values. */
#pragma once

/* The t that |t| stays below with probability 0.95, for 1 or more degrees of freedom; infinity for
 * fewer. */
double oz_student_limit(int degrees);
