/* Student's t, for intervals of confidence from few values. */
#pragma once

/* The t that |t| stays below with probability 0.95, for 1 or more degrees of freedom; infinity for
 * fewer. */
double oz_student_limit(int degrees);

/* Of values: not a number without any, or where one of them is none. */
typedef struct OzMoments {
    double mean, spread; /* spread: standard deviation; NAN for fewer than two            */
    double interval;     /* half-width of the mean's at 95 %; infinite for fewer than two */
} OzMoments;

OzMoments oz_student_moments(const double *values, int count);
