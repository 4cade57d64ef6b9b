0 BEGIN PGM BRACKET MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+100 Y+80 Z+0
3 ; CAPSTAN PROGRAM version=1
4 ; part: bracket [left]
5 ; file: bracket.p21
6 ; machine: mill
7 ; material: mild_steel
8 ; stock: 100 x 80 x 20 mm
9 ; CAPSTAN SETUP n=1 offset=PRESET1 security=20
10 ; CAPSTAN TOOL T1 H1 length=50 diameter=18 id="em18" endmill
11 ; CAPSTAN TOOL T2 H2 length=80 diameter=6 id="tap_m6" tap
12 ; set-up 1: the workpiece's +Z up, its +X to the right, its +Y to the back
13 ; set-up 1: zero PRESET1 on the raw piece as it lies: X0 at its left side, Y0 at its front, Z0 at its top; that is the point X0 Y0 Z0 of the part's drawing
14 ; set-up 1: the raw piece reaches from X0 Y0 Z-20 to X100 Y80 Z0
15 ; set-up 1: what holds the piece is not planned: fixtures and clamps are not checked
16 CYCL DEF 32.0 TOLERANCE
17 CYCL DEF 32.1 T0.01
18 CYCL DEF 32.2 HSC-MODE:0 TA0.5
19 L Z+0 R0 FMAX M91
20 M5
21 M9
22 ; CAPSTAN STEP id="rough%20pocket" n=1 tool=1 setup=1
23 CYCL DEF 32.0 TOLERANCE
24 CYCL DEF 32.1 T0.05
25 CYCL DEF 32.2 HSC-MODE:0 TA0.5
26 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
27 TOOL CALL 1 Z S3000
28 M3
29 CYCL DEF 9.0 DWELL TIME
30 CYCL DEF 9.1 DWELL 1.5
31 L X+0 Y+0 R0 FMAX
32 M8
33 L Z+10 R0 FMAX
34 L Z+2 R0 FMAX
35 L Z+0.5 R0 F600
36 CC X+3 Y+0
37 CP IPA-180 IZ-1.5 DR-
38 CC X+3 Y+0
39 CP IPA-180 IZ-1.5 DR-
40 L X+0 Y-5.5 R0
41 L X+10.123 R0
42 CC X+10.123 Y-0.5
43 C X+15.123 Y-0.5 DR+
44 L Y+0 R0
45 CC X+0 Y+0
46 C X-15.123 Y+0 DR+
47 L Z+10 R0 FMAX
48 ; end
49 L Z+0 R0 FMAX M91
50 M5
51 M9
52 M30
53 END PGM BRACKET MM
