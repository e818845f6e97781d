#include "api/both_threads.h"

#include <pthread.h>
#include <stdbool.h>

struct task {
    void (*work)(void *);
    void *what;
};

static void *task_main(void *task)
{
    const struct task *t = task;
    t->work(t->what);
    return NULL;
}

void both_threads(void (*work)(void *), void *first, void *second)
{
    pthread_t thread;
    struct task task = {.work = work, .what = first};
    const bool started = pthread_create(&thread, NULL, task_main, &task) == 0;
    if (!started) {
        work(first);
    }
    work(second);
    if (started) {
        (void)pthread_join(thread, NULL);
    }
}
