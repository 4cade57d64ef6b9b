capstan_test(motion DEPENDS motion)
