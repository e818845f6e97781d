/* aerom_validate: prints the validation page. `aerom_validate > docs/VALIDATION.md` renews it. */
#include "core/sim.h"
#include "tests/verify/check.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const introduction =
    "# Validation\n"
    "\n"
    "This page is printed by the program `aerom_validate` of the build tree:\n"
    "`build/release/bin/aerom_validate > docs/VALIDATION.md`. The same lists of checks are\n"
    "asserted by the tests labelled `verify`. Errors are relative where they are given in per\n"
    "cent, else absolute. Marks of sources: [3D] finite shell elements (CalculiX S8R, composite),\n"
    "[C] an independent calculation made for the validation data of this project, closed form: "
    "the\n"
    "formula of the text book, property: follows from the mathematics. The model page and the\n"
    "validation data are the design note and the collection of reference numbers that were made\n"
    "for this project before its code; what is quoted of them stands in the tests. The dynamic\n"
    "models beside computations of the flow through stall are on a page of their own, LOOPS.md.\n";

int main(void)
{
    sim_process_init();
    (void)fputs(introduction, stdout);
#define PRINT(name) check_print_markdown(&group_##name, stdout);
    CHECK_GROUPS(PRINT)
#undef PRINT
    return ferror(stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
