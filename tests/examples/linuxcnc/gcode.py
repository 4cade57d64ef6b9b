"""Programs of the scenarios: what stands in examples/linuxcnc/part.ngc before the first workingstep, or behind the last."""
from shop import OFFSET_Z

BIND = '  M101 P#<step>\n'
FIRST = 'M101 P0\n'
END = 'M2\n'
# Touches the piece's top where the raw piece is whole, and moves G54 there.
TOUCH = '''T9 M6
G43 H9
G0 X5 Y5
G0 Z10
M64 P0
G38.2 Z-5 F300
M65 P0
G10 L2 P1 Z[#5223 + #5063]
G0 Z10
G49
G53 G0 Z101.6
'''

# Touches the pocket's floor, and cuts the last workingstep again while more than 0.02 mm stands: a spring pass.
FLOOR_Z = OFFSET_Z - 10.0 + 100.0  # the nose's height with the probe, 100 mm long, on the floor
STANDS = 0.05
SPRING = f'''#<left> = 1
#<passes> = 0
o2 while [[#<left> GT 0.02] AND [#<passes> LT 3]]
  T9 M6
  G43 H9
  G0 X50 Y40
  G0 Z10
  M64 P0
  G38.2 Z-12 F300
  M65 P0
  #<left> = [#5063 + 10]
  G0 Z10
  G49
  G53 G0 Z101.6
  o3 if [#<left> GT 0.02]
    M101 P2
    M66 P0 L0
    M102 P2
    M66 P0 L0
    o1002 call
    M103 P2
    M111 P{FLOOR_Z}
    #<passes> = [#<passes> + 1]
  o3 endif
o2 endwhile
'''

# A tool setter beside the piece: its face is at X FACE of the machine and its top TALL mm over the piece's. The cutter of T1, which
# stands still, comes to it from the left, fast and once more slowly, 10 mm over the piece.
FACE, TALL = -50.0, 30.0
SETTER_TOP_NOSE = OFFSET_Z + TALL + 80.0  # the nose's height with T1, 80 mm long, at the setter's top
SETTER = f'''T1 M6
G43 H1
G0 X{FACE - 20} Y-30
G0 Z10
M64 P1
G38.2 X{FACE + 5} F300
G0 X[#5061 - 1]
G38.2 X{FACE + 5} F30
M65 P1
#<diameter> = [2 * [{FACE} - #5061]]
G0 X{FACE - 20}
G49
G53 G0 Z101.6
M104 P1 Q#<diameter>
'''

# Touches the pocket's right wall, at X 80, with a ball of 6 mm, and tells the plan what stands on it. Whether anything is cut once more the
# plan's while statement says: M101 P0 shows how many workingsteps there are then. Not more than five of them.
WALL_X = 77.0  # the spindle's place with the ball on the finished wall
STANDS_ROUGHED, STANDS_FINISHED = 0.3, 0.05  # on the wall, mm: the roughing's allowance, and what the first pass is said to leave
WALL_TOP_NOSE = OFFSET_Z + 100.0  # with the probe, 100 mm long
WHILE_WALL_STANDS = f'''o2 do
  T9 M6
  G43 H9
  G0 X70 Y40
  G0 Z10
  G1 Z-5 F1000
  M64 P1
  G38.2 X82 F100
  M65 P1
  #<wall> = [{WALL_X} - #5061]
  G0 X70
  G0 Z10
  G49
  G53 G0 Z101.6
  M105 P1 Q#<wall>
  M101 P0
  M66 E1 L0
  #<more> = [#5399 GE #<step>]
  o3 if [#<more> EQ 1]
    M101 P#<step>
    M66 P0 L0
    M102 P#<step>
    M66 P0 L0
    o[1000 + #<step>] call
    M103 P#<step>
    (the first pass springs, the next ones do not)
    o4 if [#<step> EQ 2]
      M113 P{WALL_X - STANDS_FINISHED}
    o4 else
      M113 P{WALL_X}
    o4 endif
    #<step> = [#<step> + 1]
  o3 endif
o2 while [[#<more> EQ 1] AND [#<step> LE 5]]
'''
