/* Late binding inside a control: a C interface. Link `capstan::late`.
 *
 * A session is opened once with the machine and its tool table; a plan is bound before its deadline, and what
 * came of it is fetched as text. Nothing is thrown, nothing is printed, and with one thread (the
 * default) none outlives a call; others wait, signals blocked, until the process ends.
 *
 * Call it with the tool retracted and the spindle stopped; on any code but CAPSTAN_LATE_OK retract and stop.
 * CAPSTAN_LATE_LATE means: the plan is checked and can be fetched, but the deadline had passed when it was
 * there. A control that went on at its deadline must not take it: the piece may no longer be as the plan has
 * it. A control that waits, retracted and stopped, may take it after the operator (or its own logic) agrees.
 * A session serves one thread at a time; several sessions may be used at once. */
#ifndef CAPSTAN_LATE_H
#define CAPSTAN_LATE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CAPSTAN_LATE_API __attribute__((visibility("default")))

typedef struct capstan_late capstan_late;

/* Counts what was added to this interface; what was there stays. 2: options by name, progress, stop, formats
 * by name. 3: capstan_late_changes; options "may" and "time". 4: capstan_late_take, capstan_late_bind_next,
 * capstan_late_steps; option "stop-at-deadline". 5: options "spindle-power", "feed-override".
 * 6: options "axis-limits", "work-offset". 7: capstan_late_left_open. 8: capstan_late_tool_state; option
 * "tool-state". 9: capstan_late_no_longer_valid, capstan_late_unsuited, capstan_late_measured; option
 * "profile". */
#define CAPSTAN_LATE_INTERFACE 9
/* Of the library that is linked. */
CAPSTAN_LATE_API unsigned capstan_late_interface(void);

typedef enum capstan_late_code {
  CAPSTAN_LATE_OK = 0,
  CAPSTAN_LATE_USAGE = 2,      /* a null or empty argument, an unknown option, no loaded tool */
  CAPSTAN_LATE_UNREADABLE = 3, /* machine, tools or plan cannot be read */
  CAPSTAN_LATE_IMPOSSIBLE = 4, /* nothing that may be cut: not bound, or not safe */
  CAPSTAN_LATE_LATE = 5,       /* a checked plan is there, and came after the deadline: see above */
  CAPSTAN_LATE_FAULT = 70      /* a fault of the library itself */
} capstan_late_code;

typedef enum capstan_late_format {
  CAPSTAN_LATE_ISO14649 = 0, /* the plan, with who bound what */
  CAPSTAN_LATE_JSON = 1,
  CAPSTAN_LATE_LINUXCNC = 2, /* the program */
  CAPSTAN_LATE_TOOL_TABLE = 3,
  CAPSTAN_LATE_AP238 = 4
} capstan_late_format;

/* Opens a session. `machine`: a machine file, or the id of a shipped machine; `tools`: a tool table or
 * library of what is in the magazine. The session is made in any case (free it with capstan_late_close); its
 * code says whether it can be used. Gives NULL only when there is no memory. */
CAPSTAN_LATE_API capstan_late* capstan_late_open(const char* machine, const char* tools);

/* The same in steps: a session without a shop (NULL only when there is no memory), its options one by one,
 * and (if wished, so that the first bind need not) the shop opened. The options are those of `capstan bind`
 * without their dashes: "machine", "tools", "workholding", "general-tolerance", "cases", "may" (what the
 * control may decide, e.g. "feeds,tools"), "time" (for the record), ...; a flag such as
 * "allow-findings" takes "yes" or "no". An option set later opens the shop anew at the next call. Without
 * "tools" the plan's own tools count as loaded. */
CAPSTAN_LATE_API capstan_late* capstan_late_create(void);
CAPSTAN_LATE_API capstan_late_code capstan_late_set(capstan_late* session, const char* option,
                                                    const char* value);
CAPSTAN_LATE_API capstan_late_code capstan_late_prepare(capstan_late* session);

/* Tells what became of the loaded tools since their table was written, in place of what was told before: text
 * of `size` bytes, a tool a line, by its number. NULL or 0 bytes: nothing is told. The option "tool-state"
 * takes the same from a file.
 *
 *     T3 broken
 *     T5 wear 0.02 length-wear 0.01 life-left 12.5     ; mm, mm, minutes of cutting
 *     T6 wear 0.02 in-table                            ; D and Z of the table are less by it already
 *
 * A broken tool, or one without life left, is not called. `wear` is radial: twice of it comes off the
 * diameter, and paths are made for that. `length-wear` comes off the length. Both are the whole since the
 * edge was new, of which only what the table has not yet is taken off. The tool table that the bound plan
 * gives says what has to be in effect. A step that cuts longer than its edge has life, behind those that
 * this plan cuts with it before, gets another tool, of the same kind first, or nothing is given (LATE-LIFE,
 * code 4). Where workingsteps are bound one after the other, lives count from the one that is bound next.
 * What was bound before is not given any more; capstan_late_bind_next goes on with it. On CAPSTAN_LATE_USAGE
 * (an unknown word, a number that is missing, negative or not finite, a tool or a word twice) nothing is
 * changed. Of a number that the table has not, the next bind warns. Needs the option "tools". */
CAPSTAN_LATE_API capstan_late_code capstan_late_tool_state(capstan_late* session, const char* states,
                                                           size_t size);

/* Binds a plan (ISO 14649, AP238 or JSON, `size` bytes) before `deadline_ms` have passed since the call. Past
 * that the code is CAPSTAN_LATE_LATE, never CAPSTAN_LATE_OK. No plan uses a tool that is not in the table, or
 * whose length the table does not state (LATE-TOOL, code 4). What the table says of a tool comes out again in
 * CAPSTAN_LATE_TOOL_TABLE number for number; offsets that count from a reference tool show by a negative
 * one, or by `length_offsets: reference` under the machine's control. */
CAPSTAN_LATE_API capstan_late_code capstan_late_bind(capstan_late* session, const char* plan, size_t size,
                                                     unsigned deadline_ms);

/* Reads a plan, so that the first capstan_late_bind_next, without one, need not. */
CAPSTAN_LATE_API capstan_late_code capstan_late_take(capstan_late* session, const char* plan, size_t size);

/* Binds `count` workingsteps only, against the piece as those before them leave it: nothing else is planned,
 * and the program is that of these steps, whole, with its end. `from` is the first of them, counted from 1 in
 * the order of the workplan; the plan must have the paths of those before, which are cut. 0: the first of
 * which something is open. Without a plan (NULL, 0): the plan that this session took or bound last, so
 * that a part is bound step by step without being read again; CAPSTAN_LATE_JSON is the whole plan as far as
 * it is bound, to go on with after a restart. A control that goes on at its deadline sets "stop-at-deadline"
 * to "yes": what is not checked by then is given up in time, with CAPSTAN_LATE_IMPOSSIBLE, in place of
 * CAPSTAN_LATE_LATE after it. */
CAPSTAN_LATE_API capstan_late_code capstan_late_bind_next(capstan_late* session, const char* plan,
                                                          size_t size, unsigned from, unsigned count,
                                                          unsigned deadline_ms);

/* What the plan at hand (taken last, or bound as far as it is) leaves open, one decision a line; empty where
 * nothing is open. NULL when there is no plan, or no memory. It is valid until the next call of it or close.
 */
CAPSTAN_LATE_API const char* capstan_late_left_open(capstan_late* session);

/* What of the plan at hand no longer holds with machine, material and tools as they are set now, a sentence a
 * line: what a bind would open or check anew; empty where nothing does. Nothing is bound. Not asked: lives
 * that are left, values that were edited, other choices (raw piece, tolerance, workholding), cases,
 * conditions, and steps that are bound in a plan that is bound step by step, which count as cut. NULL where
 * it cannot be told: capstan_late_status and capstan_late_message say why (USAGE: no plan; IMPOSSIBLE: what
 * no bind gets over, as a tool without a length). It is valid until the next call of it or close. */
CAPSTAN_LATE_API const char* capstan_late_no_longer_valid(capstan_late* session);

/* What of the plan at hand does not suit the control, before the first chip, a finding a line, errors first:
 * what the control cannot do (arcs, cycles, axes, radii, feeds, tolerances, block rate), and what the plan
 * leaves open, misses, states twice or against itself. The control is that of the option "profile" (an id, or
 * a file of what a control can do), else the machine's own. With "profile" set each bind holds its plan
 * against it, too: an error refuses it (LATE-UNSUITED, IMPOSSIBLE). NULL and validity as above. */
CAPSTAN_LATE_API const char* capstan_late_unsuited(capstan_late* session);

/* Tells what the control does and measures, and gives the broadcasts that are due by it (AP238 edition 4) as
 * lines of JSON; empty where none is. `event` is "start", "at" or "end" of the workingstep with that id, or
 * "finish" of the run. `time` is the time as the control says it, `elapsed_s` seconds since any moment that
 * is the same for all events; NULL and a negative number: not told. Of the `count` values each has the name
 * of AP238 ("spindle speed", "feedrate", "location": [x, y, z] in mm in the set-up's frame) and its value as
 * JSON. A line with "reply_to" waits: the control goes on when somebody replied. Where the plan has no
 * broadcasts, start and end of each workingstep are sent with all that is told. The run goes on while the
 * plan is bound further, and begins anew with another plan. NULL: capstan_late_status and
 * capstan_late_message say why. It is valid until the next call of it or close. */
CAPSTAN_LATE_API const char* capstan_late_measured(capstan_late* session, const char* event,
                                                   const char* workingstep, const char* time,
                                                   double elapsed_s, const char* const* names,
                                                   const char* const* values, size_t count);

/* Is called during a bind with its progress: the stage's name and a fraction from 0 to 1; NULL: no more. It
 * is called from the thread that binds, or one of its workers; of its session it may call capstan_late_stop
 * only. */
typedef void (*capstan_late_progress)(const char* stage, double fraction, void* user);
CAPSTAN_LATE_API void capstan_late_on_progress(capstan_late* session, capstan_late_progress progress,
                                               void* user);
/* Ends a running bind early, from any thread. It gives what was checked by then (CAPSTAN_LATE_OK or
 * CAPSTAN_LATE_LATE), or CAPSTAN_LATE_IMPOSSIBLE. Without a running bind it does nothing. */
CAPSTAN_LATE_API void capstan_late_stop(capstan_late* session);

/* The bound plan in a format, or NULL when there is none. It is valid until the next bind or close; `size`
 * may be NULL, the text ends with a zero byte. */
CAPSTAN_LATE_API const char* capstan_late_output(capstan_late* session, capstan_late_format format,
                                                 size_t* size);

/* The same by the format's name: "iso14649", "ap238", "json", "linuxcnc", "linuxcnc_tools". */
CAPSTAN_LATE_API const char* capstan_late_output_as(capstan_late* session, const char* format, size_t* size);

/* What changed against the plan that was brought, for the operator's screen: sentences, one a line; empty
 * where nothing did. NULL when there is no bound plan. It is valid until the next bind or close. */
CAPSTAN_LATE_API const char* capstan_late_changes(const capstan_late* session);

/* Code and diagnostics (lines of text) of the last call. Never NULL. */
CAPSTAN_LATE_API capstan_late_code capstan_late_status(const capstan_late* session);
CAPSTAN_LATE_API const char* capstan_late_message(const capstan_late* session);

/* How many workingsteps the bound plan has, those that are still open among them; 0 when there is none. */
CAPSTAN_LATE_API unsigned capstan_late_steps(const capstan_late* session);

/* Machining time of what was bound in seconds, 0 when nothing is. */
CAPSTAN_LATE_API double capstan_late_machining_seconds(const capstan_late* session);

CAPSTAN_LATE_API void capstan_late_close(capstan_late* session);

#ifdef __cplusplus
}
#endif

#endif
