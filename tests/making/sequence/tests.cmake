capstan_test(sequence DEPENDS sequence)
