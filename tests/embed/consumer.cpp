#include "consumer.h"

#include <type_traits>

/* Values that copy as C copies them. */
static_assert(std::is_trivial<buffon_estimate>::value, "buffon_estimate");
static_assert(std::is_trivial<buffon_run>::value, "buffon_run");
static_assert(std::is_trivial<buffon_rng>::value, "buffon_rng");

int main()
{
    return consumer_run();
}
