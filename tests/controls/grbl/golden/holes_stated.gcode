(CAPSTAN PROGRAM version=1)
(part: bracket [left])
(file: bracket.p21)
(machine: mill)
(material: mild_steel)
(stock: 100 x 80 x 20 mm)
(CAPSTAN SETUP n=1 offset=G54 security=20)
(CAPSTAN TOOL T1 H1 length=50 diameter=18 id="em18" endmill)
(CAPSTAN TOOL T2 H2 length=80 diameter=6 id="tap_m6" tap)
(CAPSTAN TOOL T3 H3 length=50 diameter=8 id="d8" twist_drill)
(CAPSTAN TOOL T4 H4 length=50 diameter=18 id="r8" reamer)
(set-up 1: the workpiece's +Z up, its +X to the right, its +Y to the back)
(set-up 1: zero G54 on the raw piece as it lies: X0 at its left side, Y0 at its front, Z0 at its top; that is)
(   the point X0 Y0 Z0 of the part's drawing)
(set-up 1: the raw piece reaches from X0 Y0 Z-20 to X100 Y80 Z0)
(set-up 1: what holds the piece is not planned: fixtures and clamps are not checked)

G21 G17 G90 G94 G40 G49 G80
G61
G53 G0 Z0
M5
M9

(CAPSTAN STEP id="H1%20drill" n=1 tool=3 setup=1)
G21 G17 G90 G94 G40 G80
G61
G54
(T3 d8: change the tool)
G49
T3
M0
G53 G0 Z0
G43.1 Z50
S1200 M3
G4 P1.5
G0 X20 Y20
M8
G0 Z10
G0 Z2
G1 Z-18.2 F180
G0 Z10

(CAPSTAN STEP id="H2%20drill" n=2 tool=3 setup=1)
G21 G17 G90 G94 G40 G80
G61
G54
G43.1 Z50
G0 Z20
S1200 M3
G0 X40 Y20
M8
G0 Z10
G0 Z2
G1 Z-18.2 F180
G4 P0.35
G0 Z10

G53 G0 Z0
M5
M9
(CAPSTAN STEP id="H3%20ream" n=3 tool=4 setup=1)
G21 G17 G90 G94 G40 G80
G61
G54
(T4 r8: change the tool)
G49
T4
M0
G53 G0 Z0
G43.1 Z50
S1200 M3
G4 P1.5
G0 X20 Y20
M8
G0 Z10
G0 Z2
G1 Z-18.2 F180
G1 Z10

(end)
G53 G0 Z0
M5
M9
M30
