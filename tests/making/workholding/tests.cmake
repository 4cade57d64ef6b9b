capstan_test(workholding DEPENDS workholding)
