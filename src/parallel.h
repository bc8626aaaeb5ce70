/* Threads of one run: a team that does the same work in step with its caller, round after round. */
#ifndef BUFFON_PARALLEL_H
#define BUFFON_PARALLEL_H

#include <stddef.h>

/** Work of member i of a team; i = 0 is the caller's thread. */
typedef void buffon_priv_work(size_t i, void *arg);

typedef struct buffon_priv_team buffon_priv_team;

/** Starts up to `helpers` threads. Those that cannot be started are done without; NULL if none can.
 */
buffon_priv_team *buffon_priv_team_start(size_t helpers);

/** Calls work(0, arg) here and work(1, arg) ... on the threads; returns when all have returned. */
void buffon_priv_team_run(buffon_priv_team *team, buffon_priv_work *work, void *arg);

/** Ends the threads. NULL is allowed. */
void buffon_priv_team_stop(buffon_priv_team *team);

#endif
