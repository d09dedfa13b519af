/* Threads, and what one inherits of its starter. Every thread of the program is started here. */
#pragma once

#include <pthread.h>

/* As pthread_create with no attributes: starts work(argument) in a thread that is to be joined. Its
 * log is its starter's. Returns 0 or an error number. */
int oz_thread_start(pthread_t *thread, void *(*work)(void *), void *argument);
