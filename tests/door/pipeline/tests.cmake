capstan_test(pipeline DEPENDS pipeline casebase)
