capstan_test(piece DEPENDS piece)
