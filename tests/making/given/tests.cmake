capstan_test(given DEPENDS given tooling)
