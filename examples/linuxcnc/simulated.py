"""A machine that LinuxCNC simulates, without a screen: started, switched on, worked with, ended.

LinuxCNC's own programs are started one by one in a scratch folder. LinuxCNC refuses root: started by root, it runs as
`nobody`. Every process is a child of this one and is ended with it; its shared memory, which has fixed keys, is removed,
so one machine runs at a time on a computer. Motion counts its servo periods: `fast_clock.so` (tests/linuxcnc), preloaded
into the real-time process, makes its sleeps shorter, so that minutes take seconds and the machine does the same.
"""
import ctypes
import fcntl
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

SKIPPED = 77
NOBODY = 65534
MACHINE = pathlib.Path(__file__).resolve().parent / 'machine'
# HAL, RTAPI and its unique numbers, motion, the sampler, and channels.nml.
HAL_KEY = 0x48414C32
KEYS = [HAL_KEY, 0x90280A48, 0x48484C34, 100, 0x48534130, 43701, 43702, 43703, 43704, 43705]
MODULES = ['tpmod', 'homemod', 'trivkins coordinates=XYZ',
           'motmod base_period_nsec=0 servo_period_nsec=1000000 num_joints=3',
           'limit2 names=limit-speed', 'sim_spindle names=spindle', 'scale names=rpm-to-rps',
           'lowpass names=lag-x,lag-y,lag-z', 'hypot names=lag', 'comp names=probe-at,side-at,side-below',
           'and2 names=probe,side,side-on', 'or2 names=touches', 'sampler depth=200000 cfg=ffffsfssfs']
FIRST_PARAMETER = {'G54': 5221, 'G55': 5241, 'G56': 5261, 'G57': 5281, 'G58': 5301, 'G59': 5321}
libc = ctypes.CDLL(None, use_errno=True)


class Absent(Exception):
    """LinuxCNC cannot be had here, and why."""


class Failed(Exception):
    """LinuxCNC ran, but not the program to its end, and why."""


def shared_memory():
    """Key -> (id, processes attached) of all System V segments."""
    out = {}
    for row in pathlib.Path('/proc/sysvipc/shm').read_text().splitlines()[1:]:
        word = row.split()
        out[int(word[0]) & 0xFFFFFFFF] = (int(word[1]), int(word[6]))
    return out


def remove_shared_memory(others):
    """LinuxCNC's segments that nobody uses and that are not among `others`."""
    for key, (segment, attached) in shared_memory().items():
        if key in KEYS and attached == 0 and segment not in others:
            libc.shmctl(segment, 0, None)  # 0: IPC_RMID


def children(of):
    out = []
    for entry in pathlib.Path('/proc').iterdir():
        if not entry.name.isdigit():
            continue
        try:
            stat = (entry / 'stat').read_text()
        except OSError:
            continue
        if int(stat.rsplit(')', 1)[1].split()[1]) == of:
            out.append(int(entry.name))
    return out


def kill(pid, sign):
    try:
        os.kill(pid, sign)
    except ProcessLookupError:
        pass


def reap(pids):
    """Waits for children that are being killed."""
    for pid in pids:
        try:
            os.waitpid(pid, 0)
        except ChildProcessError:
            pass


def end_children():
    """Orphans become children of this process (a subreaper), so that none is missed."""
    for sign, patience in ((signal.SIGTERM, 3.0), (signal.SIGKILL, 5.0)):
        end = time.monotonic() + patience
        told = set()
        while time.monotonic() < end:
            left = children(os.getpid())
            if not left:
                return
            for pid in left:
                if pid not in told:
                    told.add(pid)
                    kill(pid, sign)
            try:
                os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:
                pass
            time.sleep(0.02)


class Machine:
    """LinuxCNC's programs in the current folder, started one by one."""

    def __init__(self, clock_rate):
        self.log = open('linuxcnc.log', 'ab')
        self.rate = clock_rate

    def run(self, *command, **more):
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, timeout=30, **more)
        if done.returncode != 0:
            raise Absent(f'`{" ".join(command)}` ended with {done.returncode}')

    def begin(self, *command, **more):
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, **more)

    def wait_for(self, name):
        end = time.monotonic() + 10.0
        while not os.path.exists(name):
            if time.monotonic() > end or self.realtime.poll() is not None:
                raise Absent('its real-time process does not start')
            time.sleep(0.02)

    def start(self):
        self.run('linuxcncsvr', '-ini', 'machine.ini')
        fast = dict(os.environ)
        if os.path.exists('fast_clock.so'):
            fast.update(LD_PRELOAD=os.path.abspath('fast_clock.so'), CAPSTAN_CLOCK_RATE=str(self.rate))
        # The first call stays and is the real-time process; later ones hand their wish to it.
        self.realtime = self.begin('./rtapi_app', 'load', MODULES[0], env=fast)
        self.wait_for('rtapi.fifo')
        for module in MODULES[1:]:
            self.run('./rtapi_app', 'load', *module.split())
        self.run('halcmd', 'loadusr', '-Wn', 'iocontrol', 'io', '-ini', 'machine.ini')
        self.run('halcmd', '-i', 'machine.ini', '-f', 'machine.hal')
        self.begin('milltask', '-ini', 'machine.ini')
        # Of a machine that was started before, the samples go on: numbered from 0 again.
        with open('samples.txt', 'ab') as samples:
            self.sampler = subprocess.Popen(['halsampler', '-c', '0', '-t'], stdin=subprocess.DEVNULL, stdout=samples,
                                            stderr=self.log)
        self.run('halcmd', 'start')

    def lose_power(self):
        """Kills all of LinuxCNC, and whatever else this process began, in the middle of what it does.

        The sampler is no part of the machine: it writes what it has, and ends. What the kernel keeps of LinuxCNC goes too, as when
        the computer is switched off; files stay. `start` starts it again.
        """
        while left := [pid for pid in children(os.getpid()) if pid != self.sampler.pid]:
            for pid in left:
                kill(pid, signal.SIGKILL)
            reap(left)
        self.sampler.terminate()
        try:
            self.sampler.wait(5.0)
        except subprocess.TimeoutExpired as error:
            raise Failed('halsampler does not end: its last samples are lost') from error
        for key, (segment, _) in shared_memory().items():
            if key in KEYS:
                libc.shmctl(segment, 0, None)  # 0: IPC_RMID
        # A semaphore that a killed process held would never be free.
        for row in pathlib.Path('/proc/sysvipc/sem').read_text().splitlines()[1:]:
            if int(row.split()[0]) & 0xFFFFFFFF in KEYS:
                libc.semctl(int(row.split()[1]), 0, 0)
        pathlib.Path('rtapi.fifo').unlink(missing_ok=True)

    def stop(self):
        for command in (('halcmd', 'stop'), ('halcmd', 'unload', 'all'), ('./rtapi_app', 'exit')):
            try:
                subprocess.run(command, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, timeout=10)
            except (OSError, subprocess.SubprocessError):
                pass


class Operator:
    """Switches the machine on and starts the program."""

    def __init__(self, machine):
        self.machine = machine
        try:
            import linuxcnc
        except ImportError as error:
            raise Absent(f"LinuxCNC's Python module: {error}") from error
        self.lib = linuxcnc
        linuxcnc.nmlfile = os.path.abspath('channels.nml')
        self.connect()

    def connect(self):
        end = time.monotonic() + 20.0
        while True:
            try:
                status = self.lib.stat()
                status.poll()
                self.status, self.command, self.errors = status, self.lib.command(), self.lib.error_channel()
                return
            except self.lib.error as error:
                if time.monotonic() > end:
                    raise Absent(f'its task does not answer: {error}') from error
                time.sleep(0.1)

    def do(self, what, *arguments):
        what(*arguments)
        if self.command.wait_complete(10.0) not in (self.lib.RCS_DONE, None):
            self.listen()
            raise Failed(f'refused: {getattr(what, "__name__", what)}{arguments}')

    def listen(self):
        said = []
        while (message := self.errors.poll()) is not None:
            if message[0] in (self.lib.NML_ERROR, self.lib.OPERATOR_ERROR):
                said.append(str(message[1]))
        if said:
            raise Failed('; '.join(said))

    def switch_on(self):
        c, lib = self.command, self.lib
        self.do(c.state, lib.STATE_ESTOP_RESET)
        self.do(c.state, lib.STATE_ON)
        self.do(c.mode, lib.MODE_MANUAL)
        c.home(-1)
        end = time.monotonic() + 10.0
        while not all(self.status.homed[:3]):
            if time.monotonic() > end:
                raise Absent('the axes do not find home')
            time.sleep(0.02)
            self.status.poll()

    def execute(self, program, limit):
        c, s, lib = self.command, self.status, self.lib
        self.do(c.mode, lib.MODE_AUTO)
        self.do(c.program_open, os.path.abspath(program))
        c.auto(lib.AUTO_RUN, 0)
        end = time.monotonic() + limit
        begun, idle = False, 0
        since = time.monotonic()
        while True:
            time.sleep(0.01)
            s.poll()
            self.listen()
            running = s.interp_state != lib.INTERP_IDLE or s.queue != 0 or not s.inpos
            begun = begun or running or time.monotonic() > since + 2.0
            idle = 0 if running else idle + 1
            if begun and idle > 20:
                break
            if time.monotonic() > end:
                raise Failed(f'the program did not end within {limit} s (at line {s.motion_line})')
        self.listen()


def prepare(folder, files, offsets):
    """Lays down what LinuxCNC needs. `files`: name in the folder -> file; `offsets`: 'G54:0,0,-50' in mm."""
    application = shutil.which('rtapi_app')
    missing = [name for name in ('linuxcncsvr', 'halcmd', 'milltask', 'io', 'halsampler') if not shutil.which(name)]
    if application is None or missing:
        raise Absent('LinuxCNC is not installed (package linuxcnc-uspace)')
    machine = {path.name: path for path in MACHINE.iterdir()}
    # The copy of rtapi_app is not setuid: as root's it would take no preloaded clock and ask for real-time priority.
    for name, path in {**machine, 'rtapi_app': application, **files}.items():
        shutil.copyfile(path, folder / name)
    for program in ('rtapi_app', *(name for name in (*machine, *files) if name.startswith('M1'))):
        (folder / program).chmod(0o755)
    values = {5220: 1.0}
    for text in offsets:
        name, numbers = text.split(':')
        for i, number in enumerate(numbers.split(',')):
            values[FIRST_PARAMETER[name] + i] = float(number)
    rows = [f'{key}\t{values[key]:.6f}' for key in sorted(values)]
    (folder / 'offsets.var').write_text('\n'.join(rows) + '\n')


def run_inside(work, clock_rate):
    machine = Machine(clock_rate)
    try:
        machine.start()
        operator = Operator(machine)
        operator.switch_on()
        work(operator)
        time.sleep(0.1)
        return 0, ''
    except Absent as error:
        return SKIPPED, f'LinuxCNC cannot start: {error}'
    except Failed as error:
        return 1, str(error)
    finally:
        machine.stop()
        end_children()


def in_child(folder, work, clock_rate):
    """The exit status and reason of a run as an ordinary user, in a process of its own."""
    reason = folder / 'reason.txt'
    if os.geteuid() == 0:
        for path in (folder, *folder.iterdir()):
            os.chown(path, NOBODY, NOBODY)
    pid = os.fork()
    if pid == 0:
        status = 1
        try:
            if os.geteuid() == 0:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            libc.prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
            libc.prctl(1, signal.SIGTERM, 0, 0, 0)  # PR_SET_PDEATHSIG: when this process's parent is killed
            os.chdir(folder)
            for name in ('DISPLAY', 'WAYLAND_DISPLAY', 'LD_PRELOAD', 'INI_FILE_NAME'):
                os.environ.pop(name, None)
            os.environ.update(HOME=str(folder), INI_FILE_NAME='machine.ini',
                              RTAPI_FIFO_PATH=str(folder / 'rtapi.fifo'))
            status, text = run_inside(work, clock_rate)
            reason.write_text(text)
        except BaseException as error:  # the parent tells it
            reason.write_text(f'{type(error).__name__}: {error}')
        finally:
            os._exit(status)
    try:
        _, result = os.waitpid(pid, 0)
    except BaseException:  # told to stop: LinuxCNC stops first
        os.kill(pid, signal.SIGTERM)
        os.waitpid(pid, 0)
        raise
    status = os.waitstatus_to_exitcode(result)
    return status, reason.read_text() if reason.exists() else f'ended by signal {-status}'


def stop_here(*_):
    raise Failed('stopped')


def session(work, files, offsets=(), clock_rate=1.0, collect=None, keep=None):
    """Starts the machine and gives the status of `work(operator)`: 0; SKIPPED without LinuxCNC; else 1. Prints why.

    `work` runs in the machine's folder, as its user. After success `collect(folder)` takes what it left. `keep` is a
    folder for all of it, to look for faults.
    """
    signal.signal(signal.SIGTERM, stop_here)
    # One at a time on this computer, whoever asks: LinuxCNC's shared memory has fixed keys.
    lock = os.open(os.path.join(tempfile.gettempdir(), f'capstan-linuxcnc-{os.getuid()}.lock'),
                   os.O_CREAT | os.O_RDWR, 0o600)
    fcntl.flock(lock, fcntl.LOCK_EX)
    folder = pathlib.Path(tempfile.mkdtemp(prefix='capstan-linuxcnc-'))
    others = {segment for segment, _ in shared_memory().values()}
    try:
        if HAL_KEY in shared_memory():
            raise Absent('another LinuxCNC runs on this computer, or left its shared memory (ipcs -m, key 0x48414c32)')
        prepare(folder, files, offsets)
        status, reason = in_child(folder, work, clock_rate)
        if status != 0 and (folder / 'linuxcnc.log').exists():
            reason += '\n' + (folder / 'linuxcnc.log').read_text(errors='replace')[-2000:]
        if status == 0 and collect:
            collect(folder)
    except Absent as error:
        status, reason = SKIPPED, str(error)
    except Failed as error:
        status, reason = 1, str(error)
    finally:
        remove_shared_memory(others)
        if keep:
            shutil.copytree(folder, keep, dirs_exist_ok=True, ignore=shutil.ignore_patterns('*.fifo', '*.socket'))
        shutil.rmtree(folder, ignore_errors=True)
    if reason:
        print(reason)
    return status
