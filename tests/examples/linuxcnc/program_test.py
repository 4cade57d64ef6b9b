"""What examples/linuxcnc/program.py makes of a program, and what it refuses; when the adapter says yes."""
import os
import pathlib
import socket
import sys
import tempfile
import types
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / 'examples' / 'linuxcnc'))
import program  # noqa: E402

TEXT = '''(CAPSTAN PROGRAM version=1)
(CAPSTAN SETUP n=1 offset=G54 security=20)
(CAPSTAN TOOL T1 H1 length=80 diameter=8 id="mill" endmill)

G21 G17 G90 G94 G40 G49 G80
G53 G0 Z101.6
M5
M9

(CAPSTAN STEP id="rough" n=1 tool=1 setup=1)
G54
T1 M6
G43 H1
S5000 M3
G4 P1.5
G0 X10 Y20
G0 Z20
G1 Z-5 F500
G3 X10 Y20 I4 J3
G0 Z20

(end)
G53 G0 Z101.6
M5
M9
M2
'''
TABLE = {1: {'z': 80.0, 'd': 8.0}}
LIMITS = {'X': (-100.0, 100.0), 'Y': (-100.0, 100.0), 'Z': (0.0, 101.6)}


def answer(code=0, message='', text=TEXT):
    return {'code': code, 'message': message, 'program': text}


class Answers(unittest.TestCase):
    def test_a_failure_is_refused_with_its_first_error(self):
        with self.assertRaisesRegex(program.Refused, '^no tool fits'):
            program.of_answer(answer(4, 'p: warning: old\np: error: no tool fits [PIP-NO-TOOL]\np: error: more', None), 1)

    def test_a_plan_that_came_late_is_refused_though_it_is_there(self):
        with self.assertRaisesRegex(program.Refused, 'code 5'):
            program.of_answer(answer(5), 1)

    def test_a_warning_of_the_check_is_refused_and_another_is_not(self):
        with self.assertRaisesRegex(program.Refused, 'an edge lasts 5 s'):
            program.of_answer(answer(message='p: warning: an edge lasts 5 s [CHK-SPEED-MATERIAL]'), 1)
        self.assertEqual(program.of_answer(answer(message='p: warning: unit taken [TBL-UNIT]'), 2).n, 2)

    def test_a_second_set_up_is_refused(self):
        second = TEXT.replace('(CAPSTAN TOOL', '(CAPSTAN SETUP n=2 offset=G55 security=20)\n(CAPSTAN TOOL')
        with self.assertRaisesRegex(program.Refused, 'more than one set-up'):
            program.of_answer(answer(text=second), 1)


    def test_a_program_of_more_than_one_workingstep_is_refused(self):
        second = TEXT.replace('(end)', '(CAPSTAN STEP id="finish" n=2 tool=1 setup=1)\nG54\n\n(end)')
        with self.assertRaisesRegex(program.Refused, 'not that of one workingstep'):
            program.of_answer(answer(text=second), 1)


class Subroutines(unittest.TestCase):
    def setUp(self):
        self.step = program.Program(TEXT, 2)

    def test_begins_and_ends_retracted_with_the_spindle_off_and_does_not_end_the_program(self):
        lines = self.step.subroutine('now').splitlines()
        self.assertEqual(lines[1:6], ['o1002 sub', 'G21 G17 G90 G94 G40 G49 G80', 'G53 G0 Z101.6', 'M5', 'M9'])
        self.assertEqual(lines[-6:-2], ['G53 G0 Z101.6', 'M5', 'M9', 'o1002 endsub'])
        self.assertNotIn('M2', lines)

    def test_has_every_line_of_its_step_in_order(self):
        self.assertIn('\n'.join(self.step.lines), self.step.subroutine('now'))
        self.assertIn('T1 M6', self.step.lines)

    def test_only_the_whole_unaltered_text_that_is_expected_passes(self):
        text = self.step.subroutine('now')
        mark = program.END.search(text)[1]
        program.check_text(text, mark)
        for wrong, why in ((text[:-40], 'cut short'), (text.replace('Z-5', 'Z-6'), 'altered'), (text + '\n', 'cut short'),
                           (self.step.subroutine('before'), 'stale')):
            with self.assertRaisesRegex(program.Refused, why):
                program.check_text(wrong, mark)


class Machines(unittest.TestCase):
    def setUp(self):
        self.rough = program.Program(TEXT, 1)

    def test_a_tool_must_be_in_the_table_as_long_and_wide_as_the_program_has_it(self):
        program.check_tools(self.rough, TABLE)
        for table, why in (({2: TABLE[1]}, 'not in the tool table'), ({1: {'z': 79.9, 'd': 8.0}}, 'length 79.9'),
                           ({1: {'z': 80.0, 'd': 7.9}}, 'diameter 7.9')):
            with self.assertRaisesRegex(program.Refused, why):
                program.check_tools(self.rough, table)

    def test_a_tool_may_be_less_wide_by_the_wear_that_is_told_of_it_and_no_table_has(self):
        new = {1: {'z': 80.0, 'd': 8.1}}
        told = 'T2 wear 0.3\nT1 wear 0.05 life-left 3 ; of the second edge'
        self.assertEqual(program.wear_of(told), {1: 0.05, 2: 0.3})
        program.check_tools(self.rough, new, program.wear_of(told))
        program.check_tools(self.rough, TABLE, program.wear_of(told))  # the table has it by now
        for states in ('', 'T2 wear 0.05', 'T1 wear 0.05 in-table', 'T1 broken', 'T1 wear 0.04', 'T1 length-wear 0.05'):
            with self.assertRaisesRegex(program.Refused, 'diameter 8'):
                program.check_tools(self.rough, new, program.wear_of(states))
        with self.assertRaisesRegex(program.Refused, 'length 80.05'):
            program.check_tools(self.rough, {1: {'z': 80.05, 'd': 8.0}}, program.wear_of('T1 wear 0.05 length-wear 0.05'))

    def test_a_length_offset_of_another_tool_is_refused(self):
        other = program.Program(TEXT.replace('T1 M6\nG43 H1', 'T1 M6\nG43 H2'), 1)
        with self.assertRaisesRegex(program.Refused, 'names 2'):
            program.check_tools(other, {**TABLE, 2: TABLE[1]})

    def test_arcs_count_as_their_circles(self):
        # From (10, 20) round (14, 23): radius 5.
        self.assertEqual(program.reach(self.rough), {'X': (9.0, 19.0), 'Y': (18.0, 28.0), 'Z': (-5.0, 20.0)})

    def test_an_axis_must_stay_in_its_travel_with_offset_and_length(self):
        program.check_travel(self.rough, [0.0, 0.0, -74.0], 80.0, LIMITS)
        for offset, axis in (([82.0, 0.0, -74.0], 'X'), ([0.0, -119.0, -74.0], 'Y'), ([0.0, 0.0, -76.0], 'Z')):
            with self.assertRaisesRegex(program.Refused, f'^{axis} would go'):
                program.check_travel(self.rough, offset, 80.0, LIMITS)


class Status:
    """The control's: it shows its inputs some polls after they were set."""

    def __init__(self, *shown):
        self.shown, self.polls, self.ain = list(shown), 0, (2.0, 2.0)

    def poll(self):
        self.polls += 1
        if self.shown:
            self.ain = self.shown.pop(0)


class NumberOfTheWorkingstep(unittest.TestCase):
    """The program reads it as soon as the adapter has answered (part.ngc, M66)."""

    def told(self, status):
        adapter = adapter_module()
        machine = adapter.Machine.__new__(adapter.Machine)
        machine.stat = status
        with unittest.mock.patch.object(adapter.subprocess, 'run'), unittest.mock.patch.object(adapter, 'SHOWN_S', 0.05):
            machine.tell_program(first=1, steps=2)

    def test_is_waited_for_until_the_control_shows_it(self):
        status = Status((2.0, 2.0), (2.0, 2.0), (1.0, 2.0))
        self.told(status)
        self.assertEqual(status.polls, 3)

    def test_that_the_control_never_shows_is_refused(self):
        with self.assertRaisesRegex(program.Refused, 'does not show its inputs'):
            self.told(Status())


def adapter_module():
    with unittest.mock.patch.dict(sys.modules, {'linuxcnc': types.ModuleType('linuxcnc')}):
        import adapter
    return adapter


class BeginningOfTheAdapter(unittest.TestCase):
    def test_that_cannot_be_says_why_and_is_no_traceback(self):
        adapter = adapter_module()
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.object(adapter, 'Machine'), \
                unittest.mock.patch.object(sys, 'argv', ['adapter.py', '--ini', 'i', '--plan', 'p', '--machine', 'm',
                                                         '--journal', folder]):
            with self.assertRaisesRegex(SystemExit, f'^capstan: the adapter cannot begin: {folder} cannot be read: '):
                adapter.main()


class EndOfThePlanner(unittest.TestCase):
    """A planner that ended for want of memory is told from one that was killed, and from one that broke down."""

    def refused(self, script, memory=None):
        planner = adapter_module().Planner([sys.executable, '-c', 'import os, signal, sys\nsys.stdin.readline()\n' + script],
                                           memory)
        try:
            with self.assertRaises(program.Refused) as why:
                planner.ask({}, 10.0)
        finally:
            planner.end()
        return str(why.exception)

    def test_names_memory_and_the_limit_where_it_ran_out_of_it(self):
        self.assertRegex(self.refused('os._exit(12)', '64'), 'ran out of memory .* limit of 64 MB')

    def test_names_the_signal_that_killed_it(self):
        self.assertEqual(self.refused('os.kill(os.getpid(), signal.SIGKILL)', '64'),
                         'the planner was killed from outside (SIGKILL) before it answered')

    def test_names_the_signal_by_which_it_broke_down_and_the_limit_that_it_had(self):
        self.assertRegex(self.refused('os.abort()', '64'), r'broke down \(SIGABRT\) .* limit of 64 MB')
        self.assertNotIn('memory', self.refused('os.abort()'))

    def test_names_the_exit_status_else(self):
        self.assertRegex(self.refused('sys.exit(3)', '64'), 'exit status 3')


class MemoryOfTheBinder(unittest.TestCase):
    def test_is_named_with_its_limit_in_the_answer_of_a_call_that_ran_out_of_it(self):
        import binder
        full = {'code': 70, 'message': 'note: a\nerror: a fault of the library itself: std::bad_alloc\n', 'program': None}
        self.assertTrue(binder.of_memory(full, '8'))
        with self.assertRaisesRegex(program.Refused, '^planning takes more than the 8 MB of memory'):
            program.of_answer(full, 1)
        other = {'code': 70, 'message': 'error: a fault of the library itself: bad cast\n', 'program': None}
        self.assertFalse(binder.of_memory(other, '8'))
        self.assertIn('bad cast', other['message'])


class Library:
    """What of libcapstan_late.so a session needs. A bind gives `code`; `outputs` by format; `lines` are due."""

    def __init__(self, code=0, outputs=None, status=0, lines=None):
        self.open, self.made = set(), 0
        self.capstan_late_set = lambda *_: 0
        self.capstan_late_bind_next = lambda *_: code
        self.capstan_late_output = lambda session, form, size: (outputs or {}).get(form)
        self.capstan_late_status = lambda session: status
        self.capstan_late_message = lambda session: b'error: so it is\n' if code or status else b''
        self.capstan_late_steps = lambda session: 2
        self.capstan_late_measured = unittest.mock.Mock(return_value=lines)

    def capstan_late_create(self):
        self.made += 1
        self.open.add(self.made)
        return self.made

    def capstan_late_close(self, session):
        self.open.remove(session)


class SessionOfTheBinder(unittest.TestCase):
    def test_stays_until_an_option_is_not_asked_for_any_more(self):
        import binder
        library = Library()
        with unittest.mock.patch.multiple(binder.Held, session=None, options={}, plan=None):
            self.assertEqual(binder.session_for(library, {'machine': 'm'}), 1)
            binder.Held.options = {'machine': ('m', None)}
            self.assertEqual(binder.session_for(library, {'machine': 'm', 'measured': 'wall=1'}), 1)
            binder.Held.options['measured'] = ('wall=1', None)
            # What was measured is over: a session that has it would go on with it.
            self.assertEqual(binder.session_for(library, {'machine': 'm'}), 2)
        self.assertEqual(library.open, {2})


class AnswersOfTheBinder(unittest.TestCase):
    EVENT = {'event': 'end', 'workingstep': 'rough', 'time': '12:00', 'elapsed_s': 1.5,
             'measured': {'location': [1, 2, 3]}}

    def setUp(self):
        import binder
        self.binder = binder
        held = unittest.mock.patch.multiple(binder.Held, session=None, options={}, plan=None)
        held.start()
        self.addCleanup(held.stop)

    def bind(self, library):
        with tempfile.NamedTemporaryFile() as plan:
            return self.binder.bind(library, {'plan': plan.name, 'from': 1, 'options': {}, 'deadline_ms': 1})

    def test_have_program_and_plan_of_what_was_bound(self):
        bound = self.bind(Library(outputs={self.binder.LINUXCNC: b'M2', self.binder.JSON: b'{}'}))
        self.assertEqual(bound, {'code': 0, 'message': '', 'program': 'M2', 'steps': 2, 'plan': '{}'})

    def test_are_not_given_where_there_is_no_memory_for_an_output(self):
        for outputs in ({}, {self.binder.LINUXCNC: b'M2'}, {self.binder.JSON: b'{}'}):
            with self.assertRaises(MemoryError):
                self.bind(Library(outputs=outputs))

    def test_say_why_there_is_no_program(self):
        for library in (Library(code=4, outputs={self.binder.LINUXCNC: b'M2'}), Library(status=4)):
            self.assertEqual(self.bind(library), {'code': 4, 'message': 'error: so it is\n', 'program': None})

    def test_have_each_line_that_is_due(self):
        library = Library(outputs={self.binder.LINUXCNC: b'M2', self.binder.JSON: b'{}'}, lines=b'{"a":1}\n{"b":2}\n')
        self.bind(library)
        due = {'code': 0, 'message': '', 'lines': ['{"a":1}', '{"b":2}']}
        self.assertEqual(self.binder.tell(library, self.EVENT), due)
        told = library.capstan_late_measured.call_args[0]
        self.assertEqual(told[:5], (1, b'end', b'rough', b'12:00', 1.5))
        self.assertEqual((list(told[5]), list(told[6]), told[7]), ([b'location'], [b'[1, 2, 3]'], 1))

    def test_say_why_nothing_can_be_due(self):
        lost = self.binder.tell(Library(), self.EVENT)
        with self.assertRaisesRegex(program.Refused, 'the planner was ended since the workingstep was bound'):
            program.lines_due(lost)
        self.bind(Library(outputs={self.binder.LINUXCNC: b'M2', self.binder.JSON: b'{}'}))
        self.assertEqual(self.binder.tell(Library(status=2), self.EVENT)['code'], 2)
        with self.assertRaises(MemoryError):
            self.binder.tell(Library(), self.EVENT)


class MeasuredValues(unittest.TestCase):
    """By number from the control, by name to the plan."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.journal = os.path.join(folder.name, 'journal.jsonl')

    def adapter(self, material=None):
        """As it is begun, with the journal that there is."""
        out = adapter_module().Adapter.__new__(adapter_module().Adapter)
        out.names, out.values, out.journal = ['wall', 'floor'], {}, adapter_module().Journal(self.journal)
        out.options, out.tool_states = types.SimpleNamespace(material=material), adapter_module().ToolStates(None)
        return out

    def test_get_the_name_of_their_number(self):
        adapter = self.adapter()
        adapter.answer(['value', '2.000000', '-0.030000'])
        self.assertEqual(adapter.values, {'floor': -0.03})

    def test_without_a_name_are_refused(self):
        for number in ('0', '3'):
            with self.assertRaisesRegex(program.Refused, 'has no name; --values names 2'):
                self.adapter().answer(['value', number, '1'])

    def test_a_diameter_is_as_exact_as_a_program_states_it(self):
        adapter = self.adapter()
        adapter.answer(['measured', '1.000000', '7.899472'])
        self.assertEqual(adapter.journal.measured, {1: 7.8995})

    def test_diameters_and_the_material_are_known_after_a_restart(self):
        adapter = self.adapter(material='steel')
        self.assertEqual(adapter.material, 'steel')
        for words in ('measured 1 7.8', 'material brass', 'measured 1 7.9', 'measured 3 9.9', 'material aluminium'):
            adapter.answer(words.split())
        again = self.adapter(material='steel')
        self.assertEqual(again.journal.measured, {1: 7.9, 3: 9.9})
        self.assertEqual(again.material, 'aluminium')

    def test_a_diameter_of_0_takes_it_back_and_the_table_counts_again(self):
        adapter = self.adapter()
        for words in ('measured 1 7.8', 'measured 3 9.9', 'measured 1.000000 0.000000'):
            adapter.answer(words.split())
        self.assertEqual(adapter.journal.measured, {3: 9.9})
        self.assertEqual(self.adapter().journal.measured, {3: 9.9})

    def test_what_is_no_diameter_is_refused(self):
        for value in ('-1.000000', '0.000010', '-0.000010', 'nan', 'inf'):
            with self.assertRaisesRegex(program.Refused, 'expected more than 0 mm, or 0 to take the measure back'):
                self.adapter().answer(['measured', '1', value])

    def test_a_line_of_the_journal_that_the_loss_of_power_cut_short_takes_no_other_with_it(self):
        self.adapter().answer(['measured', '1', '7.8'])
        with open(self.journal, 'a') as file:
            file.write('{"event": "cut", "st')
        self.adapter().answer(['measured', '3', '9.9'])
        self.assertEqual(self.adapter().journal.measured, {1: 7.8, 3: 9.9})

    def test_that_come_between_binding_and_call_refuse_the_subroutine(self):
        step = program.Program(TEXT, 1)
        with tempfile.TemporaryDirectory() as folder:
            for words, why in ((None, None), ('value 1 0.1', 'a measured value changed since it was bound'),
                               ('material brass', 'the material changed since it was bound')):
                adapter = self.adapter()
                adapter.options = types.SimpleNamespace(material=None, subroutines=folder, broadcast=None)
                adapter.machine = types.SimpleNamespace(state=lambda measured: {'tools': TABLE})
                state = adapter.state()
                text = step.subroutine(adapter.binding(state))
                pathlib.Path(adapter.subroutine(1)).write_text(text)
                adapter.bound = {1: (step, state, program.END.search(text)[1], '{}')}
                if words is None:
                    adapter.check(1)
                    continue
                adapter.answer(words.split())
                with self.assertRaisesRegex(program.Refused, why):
                    adapter.check(1)

    def test_what_a_statement_was_decided_to_is_found_in_the_answer(self):
        words = "while 'STANDS': 'PASS' is taken, for wall (0.05) > 0.02 holds, once more"
        said = answer(message=f'p: warning: kept [PIP-CONDITION]\nnote: {words} [LATE-REOPENED]\nnote: x [LATE-REOPENED]\n')
        self.assertEqual(program.ways_taken(said), [words])
        self.assertEqual(program.ways_taken({**said, 'code': 4}), [])


def sample(number, x, z, rpm):
    return f'{number} {x} 0 {z} 10 1 {rpm} 1 7 0.001 2 \n'


class CasesOfARunInWhichThePowerWent(unittest.TestCase):
    """The roughing is cut; the power goes in the finishing, at X 20; the tool is lifted, the finishing cut whole."""

    BEFORE = [sample(0, 0, 101.6, 0), sample(1, 10, 20, 5000), sample(2, 10, 101.6, 0), sample(3, 20, 20, 5000)]
    AFTER = [sample(0, 20, 20, 0), sample(1, 20, 101.6, 0), sample(2, 30, 20, 5000), sample(3, 31, 20, 5000),
             sample(4, 31, 101.6, 0)]

    def expect_both_cut(self, rows):
        import cases
        rough, finish = cases.times(rows)
        self.assertEqual([row[2] for row in rough], [10.0, 10.0])
        self.assertEqual([row[2] for row in finish], [30.0, 31.0, 31.0])
        seconds = [row[0] for row in rough + finish]
        self.assertEqual(seconds, sorted(set(seconds)))  # time never goes back

    def test_have_the_workingstep_that_was_cut_and_not_the_one_that_was_broken_off(self):
        self.expect_both_cut(self.BEFORE + self.AFTER)

    def test_do_without_a_row_that_the_loss_cut_short(self):
        for words in ('4 21', '4', '4 21 0 20 10 1 5000 1 7 0.001'):
            self.expect_both_cut(self.BEFORE + [words + self.AFTER[0]] + self.AFTER[1:])
            self.expect_both_cut(self.BEFORE + self.AFTER + ['5' + words])

    def test_do_not_do_without_a_row_elsewhere(self):
        import cases
        with self.assertRaisesRegex(ValueError, '^line 2 is no sample; expected 11 numbers'):
            list(cases.times([self.BEFORE[0], 'overrun\n', *self.BEFORE[1:]]))

    def test_have_no_workingstep_of_a_line_of_the_journal_that_the_loss_cut_short(self):
        import cases
        with tempfile.TemporaryDirectory() as folder:
            journal = pathlib.Path(folder, 'journal.jsonl')
            journal.write_text('{"event": "cut", "step": 1, "id": "area%20rough"}\n{"event": "cut", "st')
            self.assertEqual(cases.cut(journal), ['area rough'])


class Broadcasts(unittest.TestCase):
    """Lines that are due go into a file; one that waits for a reply holds the control."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, 'lines')
        self.module = adapter_module()
        self.adapter = self.module.Adapter.__new__(self.module.Adapter)
        self.adapter.options = types.SimpleNamespace(broadcast=self.file, deadline=1.0, grace=1.0)
        self.adapter.since, self.adapter.machine, self.adapter.planner = 0.0, unittest.mock.Mock(), unittest.mock.Mock()
        status = {'actual_position': (10.0, 20.0, 101.6), 'g5x_offset': (0.0, 5.0, -50.0),
                  'tool_offset': (0.0, 0.0, 80.0), 'spindle': [{'speed': 0.0}], 'current_vel': 2.5}
        self.adapter.machine.stat.configure_mock(**status)
        self.adapter.door = socket.socket(socket.AF_UNIX)
        self.addCleanup(self.adapter.door.close)
        self.adapter.door.bind(os.path.join(folder.name, 'door'))
        self.adapter.door.listen()

    def broadcast(self, *lines, code=0, message=''):
        self.adapter.planner.ask.return_value = {'code': code, 'message': message, 'lines': list(lines)}
        self.adapter.broadcast('start', program.Program(TEXT.replace('"rough"', '"area%20rough"'), 1))

    def ask(self, words):
        """Begins to ask the adapter; gives what reads its answer."""
        caller = socket.socket(socket.AF_UNIX)
        self.addCleanup(caller.close)
        caller.connect(self.adapter.door.getsockname())
        caller.sendall((words + '\n').encode())
        return lambda: caller.recv(1000).decode().strip()

    def test_tell_the_planner_what_the_control_shows_and_write_what_is_due(self):
        self.broadcast('{"sequence":1}')
        self.broadcast('{"sequence":2}', '{"sequence":3}')
        self.assertEqual(pathlib.Path(self.file).read_text(), '{"sequence":1}\n{"sequence":2}\n{"sequence":3}\n')
        event = self.adapter.planner.ask.call_args[0][0]
        self.assertEqual(event['workingstep'], 'area rough')
        self.assertEqual(event['measured'], {'location': [10.0, 15.0, 71.6], 'spindle speed': 0.0, 'feedrate': 150.0})

    def test_are_lost_in_a_fifo_that_nobody_reads_and_hold_nobody(self):
        os.mkfifo(self.file)
        self.broadcast('{"sequence":1}')
        reader = os.open(self.file, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        self.broadcast('{"sequence":2}')
        self.assertEqual(os.read(reader, 1000), b'{"sequence":2}\n')

    def test_that_cannot_be_made_or_written_are_refused(self):
        with self.assertRaisesRegex(program.Refused, '^nothing can be broadcast: no such step'):
            self.broadcast(code=2, message='error: no such step\n')
        self.adapter.options.broadcast = os.path.dirname(self.file)
        with self.assertRaisesRegex(program.Refused, '^nothing can be broadcast: .* cannot be written: Is a directory'):
            self.broadcast('{}')

    def test_that_wait_go_on_with_their_reply_and_nothing_else_is_answered_meanwhile(self):
        answers = [self.ask(words) for words in ('material steel', 'reply 8', 'reply', '', 'reply 7')]
        self.broadcast('{"reply_to":7}')
        told = [answer() for answer in answers]
        self.assertEqual(told[-1], 'ok')
        for words in told[:-1]:
            self.assertRegex(words, 'waits for a reply to broadcast 7; ask again behind it')

    def test_that_wait_for_a_reply_which_does_not_come_end_the_program(self):
        with unittest.mock.patch.object(self.module, 'REPLIES_S', 0.05):
            with self.assertRaisesRegex(program.Refused, 'broadcast 7 within 0.05 s; expected `ask.py reply 7`'):
                self.broadcast('{"reply_to":7}')

    def test_that_do_not_wait_take_no_reply(self):
        with self.assertRaisesRegex(program.Refused, 'no broadcast of number 7 waits'):
            self.adapter.answer(['reply', '7'])


if __name__ == '__main__':
    unittest.main()
