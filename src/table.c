#include "guard.h"

#include <string.h>

#include <buffon/table.h>

#include "density_priv.h"
#include "shares.h"

/* "buffon" and a version in the upper bytes, the kind in the lowest. */
#define TABLE_MAGIC UINT64_C(0x627566666f6e0100)

size_t buffon_priv_table_more(size_t a, size_t b, size_t c)
{
    const size_t most = SIZE_MAX / 2;
    if (a > most || (b > 0 && c > (most - a) / b))
        return SIZE_MAX;
    return a + b * c;
}

static int block_is_aligned(const void *memory)
{
    return (uintptr_t)memory % _Alignof(buffon_priv_table) == 0;
}

buffon_priv_table *buffon_priv_table_begin(buffon_status *status, void *memory, size_t size,
                                           size_t wanted, table_kind kind)
{
    buffon_priv_table *table = memory;
    *status = BUFFON_OK;
    if (wanted == SIZE_MAX)
        *status = BUFFON_E_DIM;
    else if (!memory)
        *status = BUFFON_E_NULL;
    else if (size < wanted || !block_is_aligned(memory))
        *status = BUFFON_E_SIZE;
    if (*status != BUFFON_OK)
        return NULL;
    *table = (buffon_priv_table){.magic = TABLE_MAGIC + (uint64_t)kind, .bytes = wanted};
    return table;
}

/* Of all words but `mix` itself. The last may be cut short. */
static uint64_t block_mix(const buffon_priv_table *table)
{
    buffon_priv_table head = *table;
    const unsigned char *bytes = (const unsigned char *)table;
    uint64_t mix = 0, word;
    head.mix = 0;
    for (size_t at = 0; at < sizeof head; at += sizeof word) {
        memcpy(&word, (const unsigned char *)&head + at, sizeof word);
        mix = buffon_priv_mix(mix, word);
    }
    for (size_t at = sizeof head; at < table->bytes; at += sizeof word) {
        const size_t left = (size_t)table->bytes - at;
        word = 0;
        memcpy(&word, bytes + at, left < sizeof word ? left : sizeof word);
        mix = buffon_priv_mix(mix, word);
    }
    return mix;
}

void buffon_priv_table_close(buffon_priv_table *table)
{
    table->mix = block_mix(table);
}

table_kind buffon_priv_table_kind(const buffon_priv_table *table)
{
    return (table_kind)(table->magic - TABLE_MAGIC);
}

uint64_t buffon_priv_table_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    return buffon_priv_mix(mix, table->mix);
}

static int block_fails(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    (void)x, (void)pdf, (void)u, (void)n, (void)g;
    return 1;
}

static const buffon_density_ops block_refused_ops = {.sample = block_fails,
                                                     .name = "buffon.table_open"};

static buffon_status block_check(const buffon_priv_table *table, size_t size)
{
    if (!table)
        return BUFFON_E_NULL;
    if (size < sizeof *table || !block_is_aligned(table))
        return BUFFON_E_SIZE;
    if (table->magic <= TABLE_MAGIC || table->magic > TABLE_MAGIC + TABLE_BILINEAR ||
        table->bytes < sizeof *table)
        return BUFFON_E_CORRUPT;
    if (table->bytes > size)
        return BUFFON_E_SIZE;
    return table->mix == block_mix(table) ? BUFFON_OK : BUFFON_E_CORRUPT;
}

buffon_density buffon_table_open(const void *table, size_t size)
{
    const buffon_status status = block_check(table, size);
    if (status != BUFFON_OK)
        return table_refused(&block_refused_ops, 1, 1, status);
    switch (buffon_priv_table_kind(table)) {
    case TABLE_ALIAS:
    case TABLE_GUIDE:
        return buffon_priv_alias_view(table);
    case TABLE_CONSTANT:
    case TABLE_LINEAR:
    case TABLE_GRID:
        return buffon_priv_piecewise_view(table);
    case TABLE_BILINEAR:
        return buffon_priv_bilinear_view(table);
    case TABLE_ENVIRONMENT:
        break;
    }
    return buffon_priv_environment_view(table);
}
