#!/usr/bin/python3
"""The planner in a process of its own, so that whoever waits for it can end it: libcapstan_late.so behind two pipes.

    binder.py LIBRARY [MEMORY_MB]

A line of JSON in: {"plan": FILE, "from": N, "options": {NAME: VALUE}, "deadline_ms": N}; workingstep N is bound, nothing
else. A line out: {"code": N, "message": TEXT, "program": G-CODE or null, "steps": N, "plan": JSON}: the program of that
workingstep, how many there are, and the plan as far as it is bound, which is the FILE of the next one. Codes and options
are as include/capstan/capstan_late.h has them; at the deadline what is not checked is given up (stop-at-deadline).

Or: {"event": "start" or "end", "workingstep": ID, "time": TEXT, "elapsed_s": S, "measured": {NAME: VALUE}}, of the
plan that was bound last. A line out: {"code": N, "message": TEXT, "lines": [TEXT]}: the broadcasts due, in JSON.

MEMORY_MB is what planning may take beyond what the library takes when it is loaded. Where it is not enough, the answer says so; where
not even an answer can be made, the exit status is 12 (ENOMEM). Either way the process ends: what a session is worth of which a call ran
out of memory, nobody knows. It ends, too, with the process that started it.
"""
import ctypes
import errno
import json
import os
import pathlib
import resource
import signal
import sys

JSON, LINUXCNC = 1, 2  # CAPSTAN_LATE_JSON, CAPSTAN_LATE_LINUXCNC
FAULT = 70  # CAPSTAN_LATE_FAULT
USAGE = 2  # CAPSTAN_LATE_USAGE
INTERFACE = 9  # CAPSTAN_LATE_INTERFACE, at least: capstan_late_measured


def load(path):
    library = ctypes.CDLL(path)
    session, text, texts = ctypes.c_void_p, ctypes.c_char_p, ctypes.POINTER(ctypes.c_char_p)
    for name, result, arguments in (
            ('interface', ctypes.c_uint, []), ('create', session, []), ('close', None, [session]), ('set', ctypes.c_int, [session, text, text]),
            ('bind_next', ctypes.c_int, [session, text, ctypes.c_size_t, ctypes.c_uint, ctypes.c_uint, ctypes.c_uint]),
            ('measured', text, [session, text, text, text, ctypes.c_double, texts, texts, ctypes.c_size_t]),
            ('steps', ctypes.c_uint, [session]), ('status', ctypes.c_int, [session]),
            ('message', text, [session]), ('output', text, [session, ctypes.c_int, ctypes.c_void_p])):
        function = getattr(library, 'capstan_late_' + name)
        function.restype, function.argtypes = result, arguments
    if library.capstan_late_interface() < INTERFACE:
        sys.exit(f'{path} has interface {library.capstan_late_interface()}; expected {INTERFACE} or later')
    return library


class Held:
    """The session, and what it has: options as they were set, and the plan that it bound last."""
    session, options, plan = None, {}, None


def as_it_is(value):
    """An option's value, and the content of the file that it names: a tool table that changed is set anew."""
    file = pathlib.Path(value)
    return value, file.read_bytes() if file.is_file() else None


def session_for(library, options):
    """The session; another one where an option was set that is not asked for any more: nothing takes one back."""
    if Held.session and not Held.options.keys() <= options.keys():
        library.capstan_late_close(Held.session)
        Held.session = None
    if not Held.session:
        Held.session, Held.options, Held.plan = library.capstan_late_create(), {}, None
        if not Held.session:
            raise MemoryError
    return Held.session


def bind(library, request):
    # A control that has its deadline wants a checked step by then, or none.
    wanted = {**request['options'], 'stop-at-deadline': 'yes'}
    session = session_for(library, wanted)
    for name, value in wanted.items():
        now = as_it_is(value)
        if Held.options.get(name) == now:
            continue
        code = library.capstan_late_set(session, name.encode(), value.encode())
        if code != 0:
            return {'code': code, 'message': library.capstan_late_message(session).decode(), 'program': None}
        Held.options[name] = now
    plan = pathlib.Path(request['plan']).read_bytes()
    # The plan that this session bound last it need not read again.
    text, size = (None, 0) if plan == Held.plan else (plan, len(plan))
    code = library.capstan_late_bind_next(session, text, size, request['from'], 1, request['deadline_ms'])
    said = library.capstan_late_message(session).decode()
    if code == 0:
        program = library.capstan_late_output(session, LINUXCNC, None)
        so_far = library.capstan_late_output(session, JSON, None) if program else None
        if so_far:
            Held.plan = so_far
            return {'code': 0, 'message': said, 'program': program.decode(),
                    'steps': library.capstan_late_steps(session), 'plan': so_far.decode()}
        code, said = why_not(library, session)
    return {'code': code, 'message': said, 'program': None}


def why_not(library, session):
    """Code and message of a call that gave nothing."""
    code = library.capstan_late_status(session)
    if code == 0:
        raise MemoryError  # not even for a reason
    return code, library.capstan_late_message(session).decode()


def tell(library, event):
    """The broadcasts that are due by an event."""
    if not Held.session:
        return {'code': USAGE, 'lines': [],
                'message': 'error: the planner was ended since the workingstep was bound, and knows nothing of it; '
                           'start the program again'}
    measured = event['measured']
    texts = ctypes.c_char_p * len(measured)
    names = texts(*(name.encode() for name in measured))
    values = texts(*(json.dumps(value).encode() for value in measured.values()))
    lines = library.capstan_late_measured(Held.session, event['event'].encode(), event['workingstep'].encode(),
                                          event['time'].encode(), event['elapsed_s'], names, values, len(measured))
    if lines is None:
        code, said = why_not(library, Held.session)
        return {'code': code, 'message': said, 'lines': []}
    return {'code': 0, 'message': '', 'lines': [line for line in lines.decode().split('\n') if line]}


def of_memory(answer, memory_mb):
    """Whether a call ran out of memory; its answer says so then, with the limit."""
    if answer['code'] != FAULT or 'std::bad_alloc' not in answer['message']:
        return False
    limit = f'the {memory_mb} MB of memory that it may (--memory)' if memory_mb else 'the memory that this computer has'
    answer['message'] = f'error: planning takes more than {limit}; allow it more, or plan with fewer decisions open\n'
    return True


def main():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL, 0, 0, 0)  # PR_SET_PDEATHSIG
    library, memory_mb = load(sys.argv[1]), None
    if len(sys.argv) > 2:
        memory_mb = sys.argv[2]
        pages = int(pathlib.Path('/proc/self/statm').read_text().split()[0])
        most = pages * resource.getpagesize() + int(float(memory_mb) * 2 ** 20)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
    try:
        for line in sys.stdin:
            request = json.loads(line)
            answer = tell(library, request) if 'event' in request else bind(library, request)
            ends = of_memory(answer, memory_mb)
            print(json.dumps(answer), flush=True)
            if ends:
                break
    except MemoryError:
        os._exit(errno.ENOMEM)


if __name__ == '__main__':
    main()
