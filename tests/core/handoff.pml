/* A model of firmware/firmtouch/core/handoff.hpp for Spin: every order of the steps of the fast and of the slow side, on the
   machine of tests/record/ring.pml:
     - a store waits in its side's buffer, one place a location, and reaches the memory at any later moment, so stores
       overtake each other; a release store first waits until the buffer is empty;
     - a load that is not an acquire may have been made at any earlier moment, since the last acquire load of its side.
   An interrupt on one core is a special case: all steps of the fast side at once, nothing reordered.
   A request and an result have two words each, so that a torn one shows. tests/check/handoff_model.sh runs it, as it is and
   with each BUG_ defined, and compares the lines that begin with "code:" with the source. */

#define REQUESTS 4
#define IDLE 0
#define REQUESTED 1
#define MADE 2

/* The memory: `result` holds both results, the words of one behind those of the other. */
byte state = IDLE, current = 0;
byte request[2], result[4];

/* The fast side's store buffer, and the loads that it made early. */
bool fast_holds_state, holds_current, holds_request[2];
byte fast_held_state, held_current, held_request[2];
bool has_result[4];
byte got_result[4];
#define FAST_EMPTY (!fast_holds_state && !holds_current && !holds_request[0] && !holds_request[1])
/* The slow side's. */
bool slow_holds_state, holds_result[4];
byte slow_held_state, held_result[4];
bool has_request[2], has_current;
byte got_request[2], got_current;
#define SLOW_EMPTY (!slow_holds_state && !holds_result[0] && !holds_result[1] && !holds_result[2] && !holds_result[3])

byte requested, taken;
bool is_done;

#define REACH(what, i) atomic { holds_##what[i] -> what[i] = held_##what[i]; holds_##what[i] = false; held_##what[i] = 0 }
#define EARLY(what, i) atomic { !has_##what[i] && !is_done -> got_##what[i] = what[i]; has_##what[i] = true }
active proctype machine() {
end:
  do
  :: atomic { fast_holds_state -> state = fast_held_state; fast_holds_state = false; fast_held_state = 0 }
  :: atomic { slow_holds_state -> state = slow_held_state; slow_holds_state = false; slow_held_state = 0 }
  :: atomic { holds_current -> current = held_current; holds_current = false; held_current = 0 }
  :: REACH(request, 0)
  :: REACH(request, 1)
  :: REACH(result, 0)
  :: REACH(result, 1)
  :: REACH(result, 2)
  :: REACH(result, 3)
  :: EARLY(request, 0)
  :: EARLY(request, 1)
  :: EARLY(result, 0)
  :: EARLY(result, 1)
  :: EARLY(result, 2)
  :: EARLY(result, 3)
  :: atomic { !has_current && !is_done -> got_current = current; has_current = true }
  od
}

#define STORE(what, at, value) atomic { held_##what[at] = value; holds_##what[at] = true }
#define LOAD(to, what, at) \
  if \
  :: has_##what[at] -> to = got_##what[at] \
  :: to = what[at] \
  fi

/* A load of the state: a side seen its own store before it reaches the memory; what is loaded behind it is loaded anew. */
inline fast_loads(to) {
  atomic {
    /* code: __atomic_load_n(&state_, __ATOMIC_ACQUIRE) */
    if
    :: fast_holds_state -> to = fast_held_state
    :: else -> to = state
    fi;
#ifndef BUG_FAST_NOT_ACQUIRE
    has_result[0] = false; has_result[1] = false; has_result[2] = false; has_result[3] = false;
    got_result[0] = 0; got_result[1] = 0; got_result[2] = 0; got_result[3] = 0;
#endif
    skip
  }
}
inline slow_loads(to) {
  atomic {
    if
    :: slow_holds_state -> to = slow_held_state
    :: else -> to = state
    fi;
#ifndef BUG_SLOW_NOT_ACQUIRE
    has_request[0] = false; has_request[1] = false; has_current = false;
    got_request[0] = 0; got_request[1] = 0; got_current = 0;
#endif
    skip
  }
}

/* One turn after the other: takes what is made, or not; asks, or not; reads its result. `used`: the request whose result it
   must be. */
active proctype fast() {
  byte mine = 0, seen, used, word;
  do
  :: taken < REQUESTS ->
     if
     :: true -> skip /* a turn that only reads */
     :: requested < REQUESTS ->
        /* request() */
        fast_loads(seen);
        if
#ifdef BUG_REQUESTS_UNTAKEN
        :: seen != REQUESTED ->
#else
#ifdef BUG_REQUESTS_UNANSWERED
        :: seen != MADE ->
#else
        :: seen == IDLE ->
#endif
#endif
           requested++;
           STORE(request, 0, requested);
           STORE(request, 1, requested);
#ifndef BUG_REQUESTED_NOT_RELEASE
           FAST_EMPTY;
#endif
           /* code: __atomic_store_n(&state_, kRequested, __ATOMIC_RELEASE) */
           atomic { fast_held_state = REQUESTED; fast_holds_state = true }
        :: else
        fi
     :: true ->
        /* take() */
        fast_loads(seen);
        if
        :: seen == MADE ->
#ifndef BUG_NO_SWAP
           mine = 1 - mine;
           atomic { held_current = mine; holds_current = true };
#endif
           /* code: __atomic_store_n(&state_, kIdle, __ATOMIC_RELAXED) */
           atomic { fast_held_state = IDLE; fast_holds_state = true };
           taken++;
           used = taken
        :: else
        fi
     fi;
     /* result() */
     LOAD(word, result, 2 * mine);
     assert(word == used);
     LOAD(word, result, 2 * mine + 1);
     assert(word == used);
     atomic { seen = 0; word = 0 }
  :: else -> break
  od;
  is_done = true;
  assert(requested == REQUESTS)
}

active proctype slow() {
  byte seen, at, first, second, computed;
end:
  do
  :: !is_done ->
     slow_loads(seen);
     if
     :: seen == REQUESTED ->
        /* draft() */
        if
        :: has_current -> at = got_current
        :: at = current
        fi;
#ifndef BUG_DRAFT_IN_USE
        at = 1 - at;
#endif
#ifdef BUG_MADE_TOO_EARLY
        atomic { slow_held_state = MADE; slow_holds_state = true };
#endif
        LOAD(first, request, 0);
        LOAD(second, request, 1);
        assert(first == second);         /* whole */
        assert(first == computed + 1);   /* each request once, in its order */
        STORE(result, 2 * at, first);
        STORE(result, 2 * at + 1, second);
        computed = first;
#ifndef BUG_MADE_NOT_RELEASE
        SLOW_EMPTY;
#endif
        /* code: __atomic_store_n(&state_, kMade, __ATOMIC_RELEASE) */
        atomic { slow_held_state = MADE; slow_holds_state = true }
     :: else
     fi;
     atomic { seen = 0; at = 0; first = 0; second = 0 }
  :: else -> break
  od
}
