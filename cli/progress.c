#include "cli/progress.h"

#include <stdatomic.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static void print(const struct progress *p)
{
    (void)fprintf(stderr, "\r%3.0f %%", 100.0 * atomic_load(&p->share));
    (void)fflush(stderr);
}

static void *progress_main(void *of)
{
    struct progress *p = of;
    struct timespec next = {0};
    (void)clock_gettime(CLOCK_REALTIME, &next);
    (void)pthread_mutex_lock(&p->lock);
    while (!p->has_ended) {
        print(p);
        next.tv_sec++;
        while (!p->has_ended && pthread_cond_timedwait(&p->ended, &p->lock, &next) == 0) {
        }
    }
    (void)pthread_mutex_unlock(&p->lock);
    return NULL;
}

void progress_start(struct progress *p)
{
    atomic_store(&p->share, 0.0);
    p->has_ended = false;
    (void)pthread_mutex_init(&p->lock, NULL);
    (void)pthread_cond_init(&p->ended, NULL);
    p->is_shown =
        isatty(STDERR_FILENO) != 0 && pthread_create(&p->thread, NULL, progress_main, p) == 0;
}

void progress_stop(struct progress *p)
{
    if (p->is_shown) {
        (void)pthread_mutex_lock(&p->lock);
        p->has_ended = true;
        (void)pthread_cond_signal(&p->ended);
        (void)pthread_mutex_unlock(&p->lock);
        (void)pthread_join(p->thread, NULL);
        (void)fprintf(stderr, "\r     \r");
    }
    (void)pthread_cond_destroy(&p->ended);
    (void)pthread_mutex_destroy(&p->lock);
}
