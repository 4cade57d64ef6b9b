#!/usr/bin/python3
"""One question to the adapter, for M-codes and for people; ends with 0 when the answer is yes.

    ask.py bind N | check N | done N | measured TOOL DIAMETER_MM | value N NUMBER | material NAME | reply N

Ends with 1, and so ends the program that the control runs, when the adapter refuses, is not there, or does not
answer within the seconds of $CAPSTAN_PATIENCE (30): the adapter has its own watchdog over the planner, this is the
one over the adapter.
"""
import os
import socket
import sys

SOCKET = 'capstan.socket'
PATIENCE_S = 30.0  # default, unsourced


def show(text):
    """On the control's screen; the adapter's own refusals are there already."""
    try:
        import linuxcnc
        ini = linuxcnc.ini(os.environ['INI_FILE_NAME'])
        if nml := ini.find('EMC', 'NML_FILE'):
            linuxcnc.nmlfile = os.path.abspath(nml)
        linuxcnc.command().error_msg(text)
    except (ImportError, KeyError, OSError, RuntimeError):
        pass  # the exit status ends the program all the same


def main(words):
    patience = float(os.environ.get('CAPSTAN_PATIENCE', PATIENCE_S))
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as adapter:
        adapter.settimeout(patience)
        silent = False
        try:
            adapter.connect(SOCKET)
            adapter.sendall((' '.join(words) + '\n').encode())
            answer = adapter.makefile().readline().strip()
        except OSError as error:
            answer, silent = f'the adapter does not answer: {error}', True
    if answer == 'ok':
        return 0
    text = f'capstan: {answer or "the adapter ended"}'
    if silent or not answer:
        show(text)
    print(text, file=sys.stderr)
    return 1


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
