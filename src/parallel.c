#include "guard.h"

#include "parallel.h"

#ifdef BUFFON_NO_THREADS

buffon_priv_team *buffon_priv_team_start(size_t helpers)
{
    (void)helpers;
    return NULL;
}

void buffon_priv_team_run(buffon_priv_team *team, buffon_priv_work *work, void *arg)
{
    (void)team;
    work(0, arg);
}

void buffon_priv_team_stop(buffon_priv_team *team)
{
    (void)team;
}

#else

#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>

/* The integrand runs on these stacks. The default of some systems (128 KiB in musl) is too small
 * for other people's code; address space that is not touched costs nothing. */
#define PARALLEL_STACK (sizeof(void *) >= 8 ? (size_t)8 << 20 : (size_t)1 << 20)

typedef struct parallel_member {
    buffon_priv_team *team;
    size_t index;
    pthread_t thread;
} parallel_member;

struct buffon_priv_team {
    pthread_mutex_t lock;
    pthread_cond_t start, finish;
    buffon_priv_work *work; /* NULL: end */
    void *arg;
    uint64_t round;
    size_t working, members;
    parallel_member *member;
};

static void *parallel_main(void *arg)
{
    const parallel_member *self = arg;
    buffon_priv_team *team = self->team;
    uint64_t seen = 0;
    for (;;) {
        pthread_mutex_lock(&team->lock);
        while (team->round == seen)
            pthread_cond_wait(&team->start, &team->lock);
        seen = team->round;
        buffon_priv_work *work = team->work;
        void *work_arg = team->arg;
        pthread_mutex_unlock(&team->lock);
        if (work == NULL)
            return NULL;
        work(self->index, work_arg);
        pthread_mutex_lock(&team->lock);
        if (--team->working == 0)
            pthread_cond_signal(&team->finish);
        pthread_mutex_unlock(&team->lock);
    }
}

/* Signals of the host are the host's: its handlers never run on our threads. */
static void parallel_create(buffon_priv_team *team, size_t helpers)
{
    sigset_t all, before;
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0)
        return;
    if (pthread_attr_setstacksize(&attributes, PARALLEL_STACK) == 0) {
        sigfillset(&all);
        const int masked = pthread_sigmask(SIG_SETMASK, &all, &before) == 0;
        while (team->members < helpers) {
            parallel_member *member = &team->member[team->members];
            member->team = team;
            member->index = team->members + 1;
            if (pthread_create(&member->thread, &attributes, parallel_main, member) != 0)
                break;
            team->members++;
        }
        if (masked)
            pthread_sigmask(SIG_SETMASK, &before, NULL);
    }
    pthread_attr_destroy(&attributes);
}

buffon_priv_team *buffon_priv_team_start(size_t helpers)
{
    buffon_priv_team *team = helpers > 0 ? calloc(1, sizeof *team) : NULL;
    if (team == NULL)
        return NULL;
    team->member = calloc(helpers, sizeof *team->member);
    const int lock = team->member != NULL && pthread_mutex_init(&team->lock, NULL) == 0;
    const int start = lock && pthread_cond_init(&team->start, NULL) == 0;
    const int finish = start && pthread_cond_init(&team->finish, NULL) == 0;
    if (finish) {
        parallel_create(team, helpers);
        if (team->members > 0)
            return team;
        pthread_cond_destroy(&team->finish);
    }
    if (start)
        pthread_cond_destroy(&team->start);
    if (lock)
        pthread_mutex_destroy(&team->lock);
    free(team->member);
    free(team);
    return NULL;
}

static void parallel_release(buffon_priv_team *team, buffon_priv_work *work, void *arg)
{
    pthread_mutex_lock(&team->lock);
    team->work = work;
    team->arg = arg;
    team->working = team->members;
    team->round++;
    pthread_cond_broadcast(&team->start);
    pthread_mutex_unlock(&team->lock);
}

void buffon_priv_team_run(buffon_priv_team *team, buffon_priv_work *work, void *arg)
{
    if (team != NULL)
        parallel_release(team, work, arg);
    work(0, arg);
    if (team == NULL)
        return;
    pthread_mutex_lock(&team->lock);
    while (team->working > 0)
        pthread_cond_wait(&team->finish, &team->lock);
    pthread_mutex_unlock(&team->lock);
}

void buffon_priv_team_stop(buffon_priv_team *team)
{
    if (team == NULL)
        return;
    parallel_release(team, NULL, NULL);
    for (size_t i = 0; i < team->members; i++)
        pthread_join(team->member[i].thread, NULL);
    pthread_cond_destroy(&team->finish);
    pthread_cond_destroy(&team->start);
    pthread_mutex_destroy(&team->lock);
    free(team->member);
    free(team);
}

#endif
