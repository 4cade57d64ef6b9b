capstan_test(pipeline DEPENDS pipeline service casebase)
