/* The time loop allocates nothing: every allocation of the process is counted, that of BLAS and
 * LAPACK included. The allocator is interposed through the names glibc keeps behind its own; with a
 * sanitizer, which brings its own allocator, there is nothing to see. */
#include "core/coupling/march.h"
#include "core/la.h"
#include "core/num.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define COUNTS_ALLOCATIONS 1
#else
#define COUNTS_ALLOCATIONS 0
#endif

static atomic_long allocations;

#if COUNTS_ALLOCATIONS
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t n, size_t size);
extern void *__libc_realloc(void *p, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

void *malloc(size_t size)
{
    atomic_fetch_add(&allocations, 1);
    return __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    atomic_fetch_add(&allocations, 1);
    return __libc_calloc(n, size);
}

void *realloc(void *p, size_t size)
{
    atomic_fetch_add(&allocations, 1);
    return __libc_realloc(p, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    atomic_fetch_add(&allocations, 1);
    return __libc_memalign(alignment, size);
}

int posix_memalign(void **out, size_t alignment, size_t size)
{
    atomic_fetch_add(&allocations, 1);
    *out = __libc_memalign(alignment, size);
    return *out == NULL;
}
#endif

static void the_counter_counts(void **state)
{
    (void)state;
    if (!COUNTS_ALLOCATIONS) {
        skip();
    }
    const long before = atomic_load(&allocations);
    void *volatile p = malloc(100);
    free(p);
    p = aligned_alloc(64, 128);
    free(p);
    assert_int_equal(atomic_load(&allocations) - before, 2);
}

/* Marches through stall with the lifting line, which then factors anew often. */
static long allocations_of_a_march(enum integrator integrator, enum dynamic_type dynamic,
                                   int elements)
{
    struct polar_def polar = fixture_linear_polar(5.0, 0.8, 0.05, 0.3);
    struct network_def network = fixture_network(50, 0.05, 3);
    struct case_def def;
    struct model m;
    struct workspace w;
    struct record record;
    struct march march;
    struct failure fail;
    polar.cl[0] = -0.8; /* bends at 0.15: the Jacobian changes */
    polar.cl[4] = 0.8;
    fixture_paper_beam(-45.0, &polar, &def);
    def.aero.dynamic = dynamic;
    def.aero.network = &network;
    def.beam.elements = elements;
    def.flow.incidence = num_rad(8.0);
    def.solver.integrator = integrator;
    def.solver.duration = 0.2;
    assert_ok(model_build(&def, &m, &fail));
    assert_ok(workspace_init(&m, &w));
    assert_ok(record_init(&m, &record));
    march_init(&m, &w, &record, &march);
    const long before = atomic_load(&allocations);
    assert_ok(march_run(&march, NULL));
    const long count = atomic_load(&allocations) - before;
    assert_int_equal(march.steps, 1000);
    assert_true(w.counters.lifting_line_iterations > 100);
    record_done(&record);
    workspace_done(&w);
    model_done(&m);
    network_def_done(&network);
    polar_def_done(&polar);
    return count;
}

static void the_time_loop_allocates_nothing(void **state)
{
    (void)state;
    if (!COUNTS_ALLOCATIONS) {
        skip();
    }
    for (int elements = 4; elements <= 64; elements *= 4) {
        assert_int_equal(allocations_of_a_march(INTEGRATOR_EXPONENTIAL, DYNAMIC_NETWORK, elements),
                         0);
        assert_int_equal(allocations_of_a_march(INTEGRATOR_RK4_ADAPTIVE, DYNAMIC_NETWORK, elements),
                         0);
        assert_int_equal(allocations_of_a_march(INTEGRATOR_EXPONENTIAL, DYNAMIC_STALL, elements),
                         0);
    }
}

static int setup(void **state)
{
    (void)state;
    la_process_init();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_counter_counts),
        cmocka_unit_test(the_time_loop_allocates_nothing),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
