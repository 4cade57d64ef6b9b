#!/usr/bin/env python3
"""The server as it is run: examples/serve.py binds the plate, and SIGTERM ends the server and removes its socket.

    example.py CAPSTAN ROOT
"""

import os
import signal
import subprocess
import sys
import tempfile
import time

SKIPPED = 77


def main(capstan, root):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "s")
        program = os.path.join(folder, "plate.ngc")
        with subprocess.Popen([capstan, "serve", "--socket", path], stderr=subprocess.PIPE, text=True) as server:
            said = server.stderr.readline()
            if "SERVE-BEAST" in said:
                print(said)
                return SKIPPED
            made = subprocess.run([sys.executable, os.path.join(root, "examples/serve.py"), path,
                                   os.path.join(root, "examples/plate_bound.p21"),
                                   os.path.join(root, "tests/door/late/magazine.tbl"), program],
                                  capture_output=True, text=True, check=False)
            # A server that is killed leaves its socket; the next one takes it over.
            server.send_signal(signal.SIGKILL)
            server.wait()
            left = os.path.exists(path)
            with subprocess.Popen([capstan, "serve", "--socket", path], stderr=subprocess.PIPE, text=True) as second:
                again = second.stderr.readline()
                began = time.monotonic()
                second.send_signal(signal.SIGTERM)
                ended = second.wait(timeout=60)
                print(f"ended {time.monotonic() - began:.3f} s after SIGTERM")
        print(said, made.stdout, made.stderr, again)
        text = open(program, encoding="utf-8").read() if os.path.exists(program) else ""
        good = (made.returncode == 0 and "Time of the steps" in made.stdout and "'spindle speed': 2985.0" in made.stdout
                and "\nM2" in text and left and "serving on" in again and ended == 0
                and os.listdir(folder) == ["plate.ngc"])
        print(os.listdir(folder))
        return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
