"""What a plan's broadcasts report (ISO 10303-238 edition 4), made by `capstan serve`: lines of JSON in a file or FIFO.

The adapter tells the start and the end of each workingstep with what the control's status has then; the server knows the
plan and says which lines are due (docs/serve.md, "Broadcasts"). A plan that states none gets one at each start and end. A
line that waits for a reply holds the control, retracted and stopped, until a reader of the server replies.
"""
import ctypes
import datetime
import http.client
import json
import os
import signal
import socket
import subprocess
import time
import urllib.parse

from program import Refused

SOCKET = 'broadcast.socket'
BEGINS_S = 10.0  # within which the server answers for the first time. Default, unsourced
ANSWERS_S = 15.0  # longer than the server waits for a reply to a broadcast (docs/serve.md: 10 s)


def end_with_parent():
    ctypes.CDLL(None).prctl(1, signal.SIGTERM, 0, 0, 0)  # PR_SET_PDEATHSIG


class Server(http.client.HTTPConnection):
    def __init__(self):
        super().__init__('localhost', timeout=ANSWERS_S)

    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.settimeout(self.timeout)
        self.sock.connect(SOCKET)


class Broadcast:
    """The server, and its session for the plan that is cut."""

    def __init__(self, options):
        self.process = subprocess.Popen([options.capstan, 'serve', '--socket', SOCKET], stdin=subprocess.DEVNULL,
                                        preexec_fn=end_with_parent)
        until = time.monotonic() + BEGINS_S
        while not os.path.exists(SOCKET):
            if self.process.poll() is not None or time.monotonic() > until:
                self.end()
                raise Refused(f'`{options.capstan} serve` does not begin, so that nothing can be broadcast; leave --broadcast '
                              'out, or name the command with --capstan')
            time.sleep(0.02)
        self.since = time.monotonic()
        state = {'options': {'machine': options.machine},
                 'broadcast': {'at': 'start,end', 'file': os.path.abspath(options.broadcast)}}
        self.session = '/v1/sessions/' + self.ask('POST', '/v1/sessions', state)['session']

    def end(self):
        self.process.terminate()
        self.process.wait()

    def ask(self, method, path, body):
        try:
            server = Server()
            server.request(method, path, json.dumps(body) if isinstance(body, dict) else body)
            answer = json.loads(server.getresponse().read())
            server.close()
        except (OSError, http.client.HTTPException, ValueError) as error:
            raise Refused(f'nothing can be broadcast: the server does not answer: {error}') from error
        if answer['code'] != 0:
            why = [line for line in answer['message'].splitlines() if 'error: ' in line] or [f'code {answer["code"]}']
            raise Refused('nothing can be broadcast: ' + why[0].partition('error: ')[2])
        return answer

    def tell(self, event, step, machine):
        """What the control's status has now. Names are those of the AP238 edition 4 mapping; the location is the tool's tip, mm."""
        s = machine.stat
        s.poll()
        tip = [round(s.actual_position[i] - s.g5x_offset[i] - s.tool_offset[i], 6) for i in range(3)]
        measured = {'location': tip, 'spindle speed': s.spindle[0]['speed'], 'feedrate': round(60.0 * s.current_vel, 6)}
        self.ask('POST', self.session + '/measured',
                 {'event': event, 'workingstep': urllib.parse.unquote(step.id),
                  'time': datetime.datetime.now(datetime.timezone.utc).isoformat(timespec='milliseconds'),
                  'elapsed_ms': int(1000.0 * (time.monotonic() - self.since)), 'measured': measured})

    def begins(self, step, plan, machine):
        """A workingstep of a plan, as it was bound for it, is called now."""
        self.ask('PUT', self.session + '/plan', plan.encode())
        self.tell('start', step, machine)

    def ends(self, step, machine):
        self.tell('end', step, machine)
