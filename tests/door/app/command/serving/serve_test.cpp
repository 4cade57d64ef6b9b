#include <gmock/gmock.h>

#include "tests/door/app/command/command.h"

// `capstan serve` where it cannot serve: it says what to give, and listens nowhere.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ServeCommand : public CommandTest {
 protected:
  void refuses(const std::string& arguments, const std::vector<std::string>& says) const {
    const Ran ran = run("serve " + arguments);
    EXPECT_EQ(ran.code, 2) << arguments;
    for (const std::string& s : says) EXPECT_THAT(ran.err, HasSubstr(s)) << arguments;
    EXPECT_THAT(ran.err, Not(HasSubstr("serving on"))) << arguments;
  }
};

TEST_F(ServeCommand, WithoutAPlaceSaysWhatToGive) { refuses("", {"SERVE-WHERE", "--socket PATH", "--tcp"}); }

TEST_F(ServeCommand, OverTcpWantsCertificateKeyAndWhoSignsClients) {
  for (const auto& [given, missing] : std::vector<std::pair<std::string, std::string>>{
           {"", "missing: --cert, --key, --client-ca"},
           {"--cert a --key b", "missing: --client-ca"},
           {"--client-ca a --key b", "missing: --cert"},
           {"--cert a --client-ca b --socket s", "missing: --key"}})
    refuses("--tcp 127.0.0.1:0 " + given,
            {"SERVE-TCP", missing, "--tcp ADDRESS:PORT --cert FILE --key FILE --client-ca FILE"});
  EXPECT_TRUE(files().empty());
}

TEST_F(ServeCommand, ACertificateWithoutTcpIsRefused) {
  refuses("--socket s --cert a", {"SERVE-TCP", "--cert"});
  EXPECT_TRUE(files().empty());
}

TEST_F(ServeCommand, FilesThatCannotBeReadAreNamed) {
  refuses("--tcp 127.0.0.1:0 --cert none.pem --key none.key --client-ca none.pem", {"SERVE-T"});
}

}  // namespace
}  // namespace capstan::app
