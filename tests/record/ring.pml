/* A model of firmware/firmtouch/record/ring.hpp for Spin: every order of the steps of one producer and one consumer, on a
   machine that reorders as much as a weakly ordered one may:
     - a store waits in the producer's buffer, one place a location, and reaches the memory at any later moment, so stores
       overtake each other; a release store first waits until the buffer is empty;
     - a load of a slot may have been made at any earlier moment, since the last acquire load;
     - a load that is not an acquire may be made after a store that follows it (BUG_TAKEN_NOT_ACQUIRE), a store that is no
       release before a load that stands before it (BUG_TAKEN_NOT_RELEASE).
   An interrupt on one core is a special case: all steps of the producer at once, nothing reordered.
   tests/check/ring_model.sh runs it, as it is and with each BUG_ defined, and compares the lines that begin with "code:"
   with the source. Indices count modulo MOD, as 32-bit ones do modulo 2^32, and wrap on the way. */

#define CAPACITY 2
#define MOD 8
#define PUSHES 5
#define START 5 /* so that the indices wrap */
#define MINUS(a, b) (((a) + MOD - (b)) % MOD)

/* The memory. */
byte kept = START, taken = START;
byte number[CAPACITY], value[CAPACITY]; /* a slot; its value is how many were made before it */

/* The producer's store buffer. */
bool holds_kept, holds_number[CAPACITY], holds_value[CAPACITY];
byte held_kept, held_number[CAPACITY], held_value[CAPACITY];
#define EMPTY (!holds_kept && !holds_number[0] && !holds_number[1] && !holds_value[0] && !holds_value[1])
/* The consumer's store buffer, and the loads that it made early. */
bool holds_taken, has_number[CAPACITY], has_value[CAPACITY];
byte held_taken, got_number[CAPACITY], got_value[CAPACITY];

byte produced, dropped, consumed, missing;
bool is_done, is_read;

/* What reaches the memory, and which loads are made early: at any moment. */
#define REACH(what, i) atomic { holds_##what[i] -> what[i] = held_##what[i]; holds_##what[i] = false; held_##what[i] = 0 }
#define EARLY(what, i) atomic { !has_##what[i] && !is_read -> got_##what[i] = what[i]; has_##what[i] = true }
active proctype machine() {
end:
  do
  :: atomic { holds_kept -> kept = held_kept; holds_kept = false; held_kept = 0 }
  :: atomic { holds_taken -> taken = held_taken; holds_taken = false; held_taken = 0 }
  :: REACH(number, 0)
  :: REACH(number, 1)
  :: REACH(value, 0)
  :: REACH(value, 1)
  :: EARLY(number, 0)
  :: EARLY(number, 1)
  :: EARLY(value, 0)
  :: EARLY(value, 1)
  od
}

#define STORE(what, at, value) atomic { held_##what[at] = value; holds_##what[at] = true }

active proctype producer() {
  byte seen = START, mine = START, at;
  do
  :: produced < PUSHES ->
     at = mine % CAPACITY;
     /* code: __atomic_load_n(&kept_, __ATOMIC_RELAXED) */
     /* code: __atomic_load_n(&dropped_, __ATOMIC_RELAXED) */
     if
     :: MINUS(mine, seen) >= CAPACITY ->
#ifdef BUG_TAKEN_NOT_ACQUIRE
        if
        :: STORE(value, at, produced);
        :: true
        fi;
        /* Where there is no room after all, the store was never made: not a run of this machine. */
        if
        :: MINUS(mine, taken) < CAPACITY
        :: !holds_value[at] && value[at] != produced
        fi;
#endif
        /* code: __atomic_load_n(&taken_, __ATOMIC_ACQUIRE) */
        seen = taken
     :: else
     fi;
     if
#ifdef BUG_OFF_BY_ONE
     :: MINUS(mine, seen) > CAPACITY ->
#else
     :: MINUS(mine, seen) >= CAPACITY ->
#endif
        /* code: __atomic_store_n(&dropped_, dropped + 1, __ATOMIC_RELAXED) */
#ifndef BUG_UNCOUNTED
        dropped++;
#endif
        produced++
     :: else ->
#ifdef BUG_NUMBER
        STORE(number, at, MINUS(mine, START));
#else
        STORE(number, at, MINUS(mine, START) + dropped);
#endif
        STORE(value, at, produced);
        mine = (mine + 1) % MOD;
        produced++;
#ifndef BUG_KEPT_NOT_RELEASE
        EMPTY;
#endif
        /* code: __atomic_store_n(&kept_, kept + 1, __ATOMIC_RELEASE) */
        atomic { held_kept = mine; holds_kept = true }
     fi
  :: else -> break
  od;
  EMPTY;
  is_done = true
}

#define LOAD(to, what, at) \
  if \
  :: has_##what[at] -> to = got_##what[at] \
  :: to = what[at] \
  fi

active proctype consumer() {
  byte mine = START, count, k, at, n, v, next;
  bool was_done;
  do
  :: was_done = is_done;
     /* code: __atomic_load_n(&taken_, __ATOMIC_RELAXED) */
     atomic {
       /* code: __atomic_load_n(&kept_, __ATOMIC_ACQUIRE) */
       count = MINUS(kept, mine);
#ifndef BUG_KEPT_NOT_ACQUIRE
       has_number[0] = false; has_number[1] = false; has_value[0] = false; has_value[1] = false;
       got_number[0] = 0; got_number[1] = 0; got_value[0] = 0; got_value[1] = 0;
#endif
       k = 0
     };
     assert(count <= CAPACITY);
     if
     :: count == 0 && was_done -> break
     :: count == 0 && !was_done -> skip
     :: count > CAPACITY - mine % CAPACITY -> count = CAPACITY - mine % CAPACITY
     :: else
     fi;
     if
     :: count > 1 -> count = 1 /* or all: a batch */
     :: true
     fi;
#ifdef BUG_TAKEN_NOT_RELEASE
     if
     :: count > 0 -> atomic { held_taken = (mine + count) % MOD; holds_taken = true }
     :: true
     fi;
#endif
     k = 0;
     do
     :: k < count ->
        at = (mine + k) % CAPACITY;
        LOAD(n, number, at);
        LOAD(v, value, at);
        assert(n == v);    /* whole: its number is its own */
        assert(n >= next); /* they come in order */
        missing = missing + n - next;
        next = n + 1;
        consumed++;
        k++
     :: else -> break
     od;
     mine = (mine + count) % MOD;
#ifdef BUG_RELEASE_MORE
     if
     :: count == 1 -> mine = (mine + 1) % MOD
     :: else
     fi;
#endif
     if
     :: count > 0 ->
        /* code: __atomic_load_n(&taken_, __ATOMIC_RELAXED) */
        /* code: __atomic_store_n(&taken_, taken + count, __ATOMIC_RELEASE) */
        atomic { held_taken = mine; holds_taken = true }
     :: else
     fi;
     atomic { k = 0; at = 0; n = 0; v = 0; count = 0 }
  od;
  is_read = true;
  missing = missing + produced - next;
  assert(produced == PUSHES);
  assert(produced == consumed + dropped);
  assert(missing == dropped) /* the numbers say how many are missing */
}
