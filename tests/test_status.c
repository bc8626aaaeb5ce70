/* Every status has its own number, name and sentence, on the right side of zero; every other value
 * is known as unknown. */
#include <ctype.h>

#include <buffon/status.h>
#include <buffon/version.h>

#include "tap.h"

typedef struct status_row {
    const char *name;
    int number;
    const char *text;
    buffon_status value;
} status_row;

static const status_row rows[] = {
#define STATUS_ROW(name, number, text) {#name, number, text, name},
    BUFFON_STATUS_LIST(STATUS_ROW)
#undef STATUS_ROW
};

enum { ROWS = sizeof rows / sizeof rows[0] };

/* A sentence without its full stop: it stands in parentheses or after a colon. */
static int is_sentence(const char *text)
{
    const size_t n = strlen(text);
    int good = n > 3 && n < 100 && islower((unsigned char)text[0]) &&
               isalnum((unsigned char)text[n - 1]);
    for (size_t i = 0; i < n; i++)
        good &= text[i] >= ' ' && text[i] <= '~';
    return good;
}

static int is_on_its_side(const status_row *row)
{
    if (row->number < 0)
        return strncmp(row->name, "BUFFON_E_", 9) == 0;
    if (row->number > 0)
        return strncmp(row->name, "BUFFON_W_", 9) == 0 && row->number < 32; /* a bit of `doubts` */
    return strcmp(row->name, "BUFFON_OK") == 0;
}

static void test_rows(void)
{
    for (int i = 0; i < ROWS; i++) {
        const status_row *row = &rows[i];
        tap_ok((int)row->value == row->number && is_on_its_side(row), "%s is %d", row->name,
               row->number);
        tap_ok(strcmp(buffon_status_name(row->value), row->name) == 0 &&
               strcmp(buffon_status_string(row->value), row->text) == 0 && is_sentence(row->text),
               "%s: %s", row->name, buffon_status_string(row->value));
    }
}

static void test_distinct(void)
{
    int numbers = 0, names = 0, texts = 0;
    for (int i = 0; i < ROWS; i++) {
        for (int j = 0; j < i; j++) {
            numbers += rows[i].number == rows[j].number;
            names += strcmp(rows[i].name, rows[j].name) == 0;
            texts += strcmp(rows[i].text, rows[j].text) == 0;
        }
    }
    tap_ok(numbers == 0, "no two statuses have one number");
    tap_ok(names == 0, "no two have one name");
    tap_ok(texts == 0, "no two have one sentence");
}

/* Numbers are for ever: programs compare what other versions wrote down. */
static void test_frozen(void)
{
    tap_ok(BUFFON_OK == 0, "BUFFON_OK is 0");
    tap_ok(BUFFON_E_NULL == -1 && BUFFON_E_UNSUPPORTED == -17, "refusals are -1 to -17");
    tap_ok(BUFFON_E_NONFINITE == -32 && BUFFON_E_TRIES == -37, "failures of a run are -32 to -37");
    tap_ok(BUFFON_E_MISMATCH == -48 && BUFFON_E_EMPTY == -52, "those of partials are -48 to -52");
    tap_ok(BUFFON_W_CANCELLED == 1 && BUFFON_W_TOLERANCE == 9, "reservations are 1 to 9");
    tap_ok(BUFFON_DOUBT(BUFFON_W_FEW) == 32, "a reservation's bit is 2 to its number");
}

static void test_unknown(void)
{
    int unknown = 0, expected = 0;
    for (int number = -1000; number <= 1000; number++) {
        int known = 0;
        for (int i = 0; i < ROWS; i++)
            known |= rows[i].number == number;
        expected += !known;
        unknown += strcmp(buffon_status_string((buffon_status)number), "unknown status") == 0 &&
                   strcmp(buffon_status_name((buffon_status)number), "unknown") == 0;
    }
    tap_ok(unknown == expected && expected == 2001 - ROWS, "all other numbers are unknown");
}

static void test_version(void)
{
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", BUFFON_VERSION_MAJOR, BUFFON_VERSION_MINOR,
             BUFFON_VERSION_PATCH);
    tap_ok(strcmp(text, BUFFON_VERSION_STRING) == 0, "the version's string has its numbers");
    tap_ok(strcmp(buffon_version(), BUFFON_VERSION_STRING) == 0, "the library has the same");
}

int main(void)
{
    test_rows();
    test_distinct();
    test_frozen();
    test_unknown();
    test_version();
    return tap_done();
}
