"""The planner (examples/linuxcnc/binder.py) with a fault in the middle of its Nth answer.

    faulty_planner.py LIBRARY FAULT N      FAULT: killed, hung
"""
import os
import signal
import sys
import threading
import time

import binder

AFTER_S = 0.004  # planning the reference pocket anew takes some 50 ms


def signal_self(sign):
    time.sleep(AFTER_S)
    os.kill(os.getpid(), sign)


def main():
    fault, last = sys.argv[2], int(sys.argv[3])
    whole, count = binder.bind, 0

    def bind(library, request):
        nonlocal count
        count += 1
        if count != last:
            return whole(library, request)
        sign = {'killed': signal.SIGKILL, 'hung': signal.SIGSTOP}[fault]
        later = threading.Thread(target=signal_self, args=(sign,))
        later.start()
        answer = whole(library, request)
        later.join()  # on a busy computer planning may be the faster one: no answer leaves before the fault
        return answer

    binder.bind = bind
    del sys.argv[2:]
    binder.main()


main()
