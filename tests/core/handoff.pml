/* A model of firmware/firmtouch/core/handoff.hpp for Spin: every order of the steps of the fast and of the slow side, on the
   machine of tests/record/ring.pml:
     - a store waits in its side's buffer, one place a location, and reaches the memory at any later moment, so stores
       overtake each other; a release store first waits until the buffer is empty;
     - a load that is not an acquire may have been made at any earlier moment, since the last acquire load of its side.
   An interrupt on one core is a special case: all steps of the fast side at once, nothing reordered.
   A question and an answer have two words each, so that a torn one shows. tests/check/handoff_model.sh runs it, as it is and
   with each BUG_ defined, and compares the lines that begin with "code:" with the source. */

#define QUESTIONS 4
#define IDLE 0
#define ASKED 1
#define MADE 2

/* The memory: `answer` holds both answers, the words of one behind those of the other. */
byte state = IDLE, front = 0;
byte question[2], answer[4];

/* The fast side's store buffer, and the loads that it made early. */
bool fast_holds_state, holds_front, holds_question[2];
byte fast_held_state, held_front, held_question[2];
bool has_answer[4];
byte got_answer[4];
#define FAST_EMPTY (!fast_holds_state && !holds_front && !holds_question[0] && !holds_question[1])
/* The slow side's. */
bool slow_holds_state, holds_answer[4];
byte slow_held_state, held_answer[4];
bool has_question[2], has_front;
byte got_question[2], got_front;
#define SLOW_EMPTY (!slow_holds_state && !holds_answer[0] && !holds_answer[1] && !holds_answer[2] && !holds_answer[3])

byte asked, taken;
bool is_done;

#define REACH(what, i) atomic { holds_##what[i] -> what[i] = held_##what[i]; holds_##what[i] = false; held_##what[i] = 0 }
#define EARLY(what, i) atomic { !has_##what[i] && !is_done -> got_##what[i] = what[i]; has_##what[i] = true }
active proctype machine() {
end:
  do
  :: atomic { fast_holds_state -> state = fast_held_state; fast_holds_state = false; fast_held_state = 0 }
  :: atomic { slow_holds_state -> state = slow_held_state; slow_holds_state = false; slow_held_state = 0 }
  :: atomic { holds_front -> front = held_front; holds_front = false; held_front = 0 }
  :: REACH(question, 0)
  :: REACH(question, 1)
  :: REACH(answer, 0)
  :: REACH(answer, 1)
  :: REACH(answer, 2)
  :: REACH(answer, 3)
  :: EARLY(question, 0)
  :: EARLY(question, 1)
  :: EARLY(answer, 0)
  :: EARLY(answer, 1)
  :: EARLY(answer, 2)
  :: EARLY(answer, 3)
  :: atomic { !has_front && !is_done -> got_front = front; has_front = true }
  od
}

#define STORE(what, at, value) atomic { held_##what[at] = value; holds_##what[at] = true }
#define LOAD(to, what, at) \
  if \
  :: has_##what[at] -> to = got_##what[at] \
  :: to = what[at] \
  fi

/* A load of the state: a side sees its own store before it reaches the memory; what is loaded behind it is loaded anew. */
inline fast_looks(to) {
  atomic {
    /* code: __atomic_load_n(&state_, __ATOMIC_ACQUIRE) */
    if
    :: fast_holds_state -> to = fast_held_state
    :: else -> to = state
    fi;
#ifndef BUG_FAST_NOT_ACQUIRE
    has_answer[0] = false; has_answer[1] = false; has_answer[2] = false; has_answer[3] = false;
    got_answer[0] = 0; got_answer[1] = 0; got_answer[2] = 0; got_answer[3] = 0;
#endif
    skip
  }
}
inline slow_looks(to) {
  atomic {
    if
    :: slow_holds_state -> to = slow_held_state
    :: else -> to = state
    fi;
#ifndef BUG_SLOW_NOT_ACQUIRE
    has_question[0] = false; has_question[1] = false; has_front = false;
    got_question[0] = 0; got_question[1] = 0; got_front = 0;
#endif
    skip
  }
}

/* One turn after the other: takes what is made, or not; asks, or not; reads its answer. `used`: the question whose answer it
   must be. */
active proctype fast() {
  byte mine = 0, sees, used, word;
  do
  :: taken < QUESTIONS ->
     if
     :: true -> skip /* a turn that only reads */
     :: asked < QUESTIONS ->
        /* ask() */
        fast_looks(sees);
        if
#ifdef BUG_ASKS_UNTAKEN
        :: sees != ASKED ->
#else
#ifdef BUG_ASKS_UNANSWERED
        :: sees != MADE ->
#else
        :: sees == IDLE ->
#endif
#endif
           asked++;
           STORE(question, 0, asked);
           STORE(question, 1, asked);
#ifndef BUG_ASKED_NOT_RELEASE
           FAST_EMPTY;
#endif
           /* code: __atomic_store_n(&state_, kAsked, __ATOMIC_RELEASE) */
           atomic { fast_held_state = ASKED; fast_holds_state = true }
        :: else
        fi
     :: true ->
        /* take() */
        fast_looks(sees);
        if
        :: sees == MADE ->
#ifndef BUG_NO_SWAP
           mine = 1 - mine;
           atomic { held_front = mine; holds_front = true };
#endif
           /* code: __atomic_store_n(&state_, kIdle, __ATOMIC_RELAXED) */
           atomic { fast_held_state = IDLE; fast_holds_state = true };
           taken++;
           used = taken
        :: else
        fi
     fi;
     /* answer() */
     LOAD(word, answer, 2 * mine);
     assert(word == used);
     LOAD(word, answer, 2 * mine + 1);
     assert(word == used);
     atomic { sees = 0; word = 0 }
  :: else -> break
  od;
  is_done = true;
  assert(asked == QUESTIONS)
}

active proctype slow() {
  byte sees, at, first, second, answered;
end:
  do
  :: !is_done ->
     slow_looks(sees);
     if
     :: sees == ASKED ->
        /* draft() */
        if
        :: has_front -> at = got_front
        :: at = front
        fi;
#ifndef BUG_DRAFT_IN_USE
        at = 1 - at;
#endif
#ifdef BUG_MADE_TOO_EARLY
        atomic { slow_held_state = MADE; slow_holds_state = true };
#endif
        LOAD(first, question, 0);
        LOAD(second, question, 1);
        assert(first == second);         /* whole */
        assert(first == answered + 1);   /* each question once, in its order */
        STORE(answer, 2 * at, first);
        STORE(answer, 2 * at + 1, second);
        answered = first;
#ifndef BUG_MADE_NOT_RELEASE
        SLOW_EMPTY;
#endif
        /* code: __atomic_store_n(&state_, kMade, __ATOMIC_RELEASE) */
        atomic { slow_held_state = MADE; slow_holds_state = true }
     :: else
     fi;
     atomic { sees = 0; at = 0; first = 0; second = 0 }
  :: else -> break
  od
}
