#!/usr/bin/python3
"""The planner in a process of its own, so that whoever waits for it can end it: libcapstan_late.so behind two pipes.

    binder.py LIBRARY [MEMORY_MB]

A line of JSON in: {"plan": FILE, "options": {NAME: VALUE}, "deadline_ms": N}; a line out: {"code": N, "message": TEXT,
"program": G-CODE or null}, codes and options as include/capstan/capstan_late.h has them. MEMORY_MB is what planning
may take beyond what the library takes when it is loaded. The process ends with the one that started it.
"""
import ctypes
import json
import pathlib
import resource
import signal
import sys

LINUXCNC = 2  # CAPSTAN_LATE_LINUXCNC
INTERFACE = 2  # CAPSTAN_LATE_INTERFACE, at least


def load(path):
    library = ctypes.CDLL(path)
    session, text = ctypes.c_void_p, ctypes.c_char_p
    for name, result, arguments in (
            ('interface', ctypes.c_uint, []), ('create', session, []), ('set', ctypes.c_int, [session, text, text]),
            ('bind', ctypes.c_int, [session, text, ctypes.c_size_t, ctypes.c_uint]),
            ('message', text, [session]), ('output', text, [session, ctypes.c_int, ctypes.c_void_p])):
        function = getattr(library, 'capstan_late_' + name)
        function.restype, function.argtypes = result, arguments
    if library.capstan_late_interface() < INTERFACE:
        sys.exit(f'{path} has interface {library.capstan_late_interface()}; expected {INTERFACE} or later')
    return library


def bind(library, session, request):
    for name, value in request['options'].items():
        code = library.capstan_late_set(session, name.encode(), value.encode())
        if code != 0:
            return {'code': code, 'message': library.capstan_late_message(session).decode(), 'program': None}
    plan = pathlib.Path(request['plan']).read_bytes()
    code = library.capstan_late_bind(session, plan, len(plan), request['deadline_ms'])
    program = library.capstan_late_output(session, LINUXCNC, None) if code == 0 else None
    return {'code': code, 'message': library.capstan_late_message(session).decode(),
            'program': program.decode() if program else None}


def main():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL, 0, 0, 0)  # PR_SET_PDEATHSIG
    library = load(sys.argv[1])
    session = library.capstan_late_create()
    if len(sys.argv) > 2:
        pages = int(pathlib.Path('/proc/self/statm').read_text().split()[0])
        most = pages * resource.getpagesize() + int(float(sys.argv[2]) * 2 ** 20)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
    for line in sys.stdin:
        print(json.dumps(bind(library, session, json.loads(line))), flush=True)


if __name__ == '__main__':
    main()
