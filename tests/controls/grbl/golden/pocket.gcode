(CAPSTAN PROGRAM version=1)
(part: bracket [left])
(file: bracket.p21)
(machine: mill)
(material: mild_steel)
(stock: 100 x 80 x 20 mm)
(CAPSTAN SETUP n=1 offset=G54 security=20)
(CAPSTAN TOOL T1 H1 length=50 diameter=18 id="em18" endmill)
(CAPSTAN TOOL T2 H2 length=80 diameter=6 id="tap_m6" tap)
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

(CAPSTAN STEP id="rough%20pocket" n=1 tool=1 setup=1)
G21 G17 G90 G94 G40 G80
G61
G54
(T1 em18: change the tool, and set the zero of Z with it)
T1 M6
G53 G0 Z0
S3000 M3
G4 P1.5
G0 X0 Y0
M8
G0 Z10
G0 Z2
G1 Z0.5 F600
G2 X6 Y0 Z-1 I3 J0
G2 X0 Y0 Z-2.5 I-3 J0
G1 Y-5.5
G1 X10.123
G3 X15.123 Y-0.5 I0 J5
G1 Y0
G3 X-15.123 Y0 I-15.123 J0
G0 Z10

(end)
G53 G0 Z0
M5
M9
M30
