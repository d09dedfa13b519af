/* The benchmark's rows as a table for people and as bench.csv, written as they come. */
#pragma once

#include "bench/bench_row.h"

#include <stdio.h>

/* Writes the heading of the table to `text` and of bench.csv to `csv`. */
void oz_bench_table_begin(FILE *text, FILE *csv);

/* Writes one row to both. */
void oz_bench_table_add(const OzBenchRow *row, FILE *text, FILE *csv);

/* What the headings mean, one line each. */
void oz_bench_table_explain(FILE *text);
