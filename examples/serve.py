"""Binds a plan at the machine through `capstan serve --socket SOCKET`.

    serve.py SOCKET PLAN TOOL_TABLE PROGRAM
"""

import http.client
import json
import socket
import sys

SOCKET, PLAN, TOOL_TABLE, PROGRAM = sys.argv[1:]


class Capstan(http.client.HTTPConnection):
    def connect(self):
        self.sock = socket.socket(socket.AF_UNIX)
        self.sock.connect(SOCKET)

    def ask(self, method, path, body=None):
        self.request(method, path, json.dumps(body) if isinstance(body, dict) else body)
        reply = self.getresponse()
        text = reply.read().decode()
        return json.loads(text) if reply.headers["Content-Type"] == "application/json" else text


capstan = Capstan("localhost")
state = {"options": {"machine": "generic_vmc"}, "tool_table": open(TOOL_TABLE).read(),
         "broadcast": {"at": "end"}}  # where the plan states no broadcast
at = "/v1/sessions/" + capstan.ask("POST", "/v1/sessions", state)["session"]
capstan.ask("PUT", at + "/plan", open(PLAN).read())
print(capstan.ask("GET", at + "/open")["open"])
bound = capstan.ask("POST", at + "/bind", {"deadline_ms": 60000})
print(bound["status"], bound["machining_s"])
print(bound["changes"])
if bound["status"] == "OK":  # on anything else: retract and stop
    open(PROGRAM, "w").write(capstan.ask("GET", at + "/output/linuxcnc"))
capstan.ask("POST", at + "/measured", {"event": "start", "workingstep": "ROUGH POCKET"})
print(capstan.ask("POST", at + "/measured", {"event": "end", "workingstep": "ROUGH POCKET", "time": "12:04:31",
                                             "measured": {"spindle speed": 2985.0}})["lines"])
capstan.ask("DELETE", at)
