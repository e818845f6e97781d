/* api/number_text.h
 * Doubles as text that reads back bit-equal. Free of state. */
#ifndef AEROM_API_NUMBER_TEXT_H
#define AEROM_API_NUMBER_TEXT_H

#include <stddef.h>

enum { NUMBER_TEXT_SIZE = 32 };

/* Shortest of %.15g, %.16g, %.17g that reads back bit-equal; finite values. Returns its length. */
size_t number_text(double value, char text[NUMBER_TEXT_SIZE]);
/* Which of the three: 15, 16 or 17. */
int number_digits(double value);

/* The same by the C library alone, twenty times slower: what the other one must agree with. */
size_t number_text_plain(double value, char text[NUMBER_TEXT_SIZE]);

#endif
