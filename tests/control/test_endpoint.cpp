#include <gtest/gtest.h>

#include "control/endpoint.hpp"

namespace pelagos {
namespace {

std::string read_back(const char* text) {
  const EndpointResult result = parse_endpoint(text);
  return result.endpoint ? to_string(*result.endpoint) : "refused";
}

TEST(Endpoint, TakesTheUsualForms) {
  EXPECT_EQ(read_back("127.0.0.1:7410"), "127.0.0.1:7410");
  EXPECT_EQ(read_back("bridge-3:1"), "bridge-3:1");
  EXPECT_EQ(read_back("localhost"), "localhost:7410");
  EXPECT_EQ(read_back(":65535"), "127.0.0.1:65535");
  EXPECT_EQ(read_back("0.0.0.0:0"), "0.0.0.0:0");
  EXPECT_EQ(read_back("[::1]:9"), "[::1]:9");
  EXPECT_EQ(read_back("[::1]"), "[::1]:7410");
}

TEST(Endpoint, RefusesTheRestSayingWhatIsAllowed) {
  for (const char* text : {"", ":", "a:", "a:b", "a:65536", "a:-1", "a:1x", "a:1:2", "[::1", "[]:1", "[::1]x",
                           "[::1]:", "a b:1", "http://a:1"}) {
    const EndpointResult result = parse_endpoint(text);
    EXPECT_FALSE(result.endpoint) << text;
    EXPECT_NE(result.error.find("allowed: HOST:PORT"), std::string::npos) << text;
  }
}

TEST(Endpoint, OfLoopbackIsOpenToNobody) {
  for (const char* host : {"127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1", "localhost"})
    EXPECT_EQ(describe_reach(host), "") << host;
}

TEST(Endpoint, OpenToANetworkIsDescribedInWords) {
  for (const char* host : {"0.0.0.0", "::", "::ffff:0.0.0.0", "192.0.2.7", "2001:db8::7", "::ffff:192.0.2.7"}) {
    const std::string words = describe_reach(host);
    for (const char* part : {"every machine that reaches", "no password", "--control 127.0.0.1:PORT"})
      EXPECT_NE(words.find(part), std::string::npos) << host << ": " << words;
  }
  EXPECT_NE(describe_reach("192.0.2.7").find("reaches 192.0.2.7 can"), std::string::npos);
}

}  // namespace
}  // namespace pelagos
