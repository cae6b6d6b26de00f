#include "spring_workbench/config/yaml_fields.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <functional>

#include "support/temporary_folder.h"

namespace spring_workbench::config::yaml_fields_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const validation::InputError& e) {
    const std::string message = e.what();
    for (const char c : message) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c))) << "one line: " << message;
    return message;
  }
  return "";
}

testing::AssertionResult names(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    if (message.find(part) == std::string::npos)
      return testing::AssertionFailure() << part << " is not in: " << message;
  }
  return testing::AssertionSuccess();
}

YAML::Node node(const std::string& text) { return YAML::Load(text); }

TEST(NumberRule, AllowsItsRangeAndNeverNan) {
  for (const validation::NumberRule& rule :
       {validation::any_number(), validation::positive(), validation::not_negative(), validation::between(-1.0, 2.0)}) {
    EXPECT_FALSE(rule.allows(std::nan("")));
    EXPECT_FALSE(rule.allows(infinity));
    EXPECT_FALSE(rule.allows(-infinity));
  }
  EXPECT_TRUE(validation::any_number().allows(-1e300));
  EXPECT_FALSE(validation::positive().allows(0.0));
  EXPECT_TRUE(validation::positive().allows(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(validation::not_negative().allows(0.0));
  EXPECT_FALSE(validation::not_negative().allows(-1e-300));
  EXPECT_TRUE(validation::between(-1.0, 2.0).allows(-1.0));
  EXPECT_TRUE(validation::between(-1.0, 2.0).allows(2.0));
  EXPECT_FALSE(validation::between(-1.0, 2.0).allows(2.0000001));
  validation::NumberRule stiffness = validation::positive();
  stiffness.infinity_allowed = true;
  EXPECT_TRUE(stiffness.allows(infinity));
  EXPECT_FALSE(stiffness.allows(-infinity));
  EXPECT_FALSE(stiffness.allows(std::nan("")));
}

TEST(NumberRule, SaysWhatItAllows) {
  EXPECT_EQ(validation::any_number().text(), "a number");
  EXPECT_EQ(validation::positive().text(), "a number > 0");
  EXPECT_EQ(validation::not_negative().text(), "a number >= 0");
  EXPECT_EQ(validation::between(0.0, 0.1).in("s").text(), "a number between 0 and 0.1 s");
  EXPECT_EQ(validation::positive_or_infinite().in("N·m").text(), "a number > 0 N·m, or .inf");
  EXPECT_EQ(validation::any_number().in("m").text(), "a number in m");
  EXPECT_EQ(validation::not_negative().in("–").text(), "a number >= 0") << "without a unit";
  EXPECT_EQ(validation::positive().text(infinity), "a finite number > 0") << "if infinity was given";
  EXPECT_EQ(validation::positive_or_infinite().text(), "a number > 0, or .inf");
  EXPECT_EQ(validation::between(1e-6, 1.0).text(), "a number between 1e-6 and 1");
  EXPECT_EQ(validation::between(-1e9, 123456.789).text(), "a number between -1e9 and 123456.789");
}

TEST(YamlFields, ReadNumbersOfEverySpelling) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"1.5", 1.5}, {"-2", -2.0}, {"1e3", 1000.0}, {"2.0e+4", 20000.0}, {".5", 0.5}}) {
    EXPECT_EQ(read_number(node(text), "file", "key", validation::any_number()), value);
  }
  validation::NumberRule rule = validation::positive();
  rule.infinity_allowed = true;
  EXPECT_EQ(read_number(node(".inf"), "file", "key", rule), infinity);
}

TEST(YamlFields, RefuseWithPlaceKeyValueAndRule) {
  for (const std::string text : {"-1", "0", ".nan", ".inf", "-.inf", "abc", "[1]", "{a: 1}", "1e999", "1 2"}) {
    const YAML::Node map = node("first: 1\nkey: " + text);
    const std::string message =
        message_of([&] { read_number(map["key"], "file.yaml", "some.key", validation::positive()); });
    const std::string number = text.find('.') != text.npos ? "a finite number" : "a number";
    EXPECT_EQ(message, "file.yaml:2: some.key: invalid value '" + text + "': expected " + number + " > 0");
  }
  for (const std::string text : {"''", "~", ""}) {
    const YAML::Node map = node("first: 1\nkey: " + text);
    EXPECT_EQ(message_of([&] { read_number(map["key"], "file.yaml", "some.key", validation::positive()); }),
              "file.yaml:2: some.key: invalid value '': expected a number > 0");
  }
  EXPECT_TRUE(
      names(message_of([] { validation::check_number("command line", "step", std::nan(""), validation::positive()); }),
            {"command line: step: invalid value 'nan': expected a finite number > 0"}));
  EXPECT_NO_THROW(validation::check_number("command line", "step", 1.0, validation::positive()));
}

TEST(YamlFields, AFieldThatIsNotThereIsRefusedNotACrash) {
  const YAML::Node map = node("a: 1");
  const YAML::Node& constant = map;
  EXPECT_EQ(message_of([&] { read_number(constant["b"], "f", "b", validation::any_number()); }),
            "f: missing required key b: a number");
  EXPECT_NE(message_of([&] { read_integer(constant["b"], "f", "b", 0, 1); }), "");
  EXPECT_NE(message_of([&] { read_bool(constant["b"], "f", "b"); }), "");
  EXPECT_NE(message_of([&] { read_string(constant["b"], "f", "b"); }), "");
  EXPECT_NE(message_of([&] { read_choice(constant["b"], "f", "b", {"x"}); }), "");
  EXPECT_NE(message_of([&] { read_numbers(constant["b"], "f", "b", 2); }), "");
  EXPECT_NE(message_of([&] { read_pose(constant["b"], "f", "b"); }), "");
  EXPECT_EQ(message_of([&] { check_keys(constant["b"], "f", "b.", {"x"}); }), "f: missing required key b: a map");
}

TEST(YamlFields, AMissingKeyIsRefusedWithTheLineOfItsMap) {
  const YAML::Node map = node("first: 1\ntop:\n  a: true");
  EXPECT_TRUE(read_required(map["top"], "f", "top.", "a", read_bool));
  EXPECT_EQ(message_of([&] { read_required(map["top"], "f", "top.", "b", read_bool); }),
            "f:3: missing required key top.b: true or false");
  EXPECT_EQ(message_of([&] { read_required(YAML::Node(YAML::NodeType::Map), "f", "", "b", read_bool); }),
            "f: missing required key b: true or false");
}

TEST(YamlFields, WhatIsNoMapIsRefusedWithItsKey) {
  const YAML::Node map = node("first: 1\nobjects: {box: 3}");
  EXPECT_EQ(message_of([&] { check_keys(map["objects"]["box"], "f", "objects.box.", {}); }),
            "f:2: objects.box: invalid value '3': expected a map");
}

TEST(YamlFields, IntegersStayIntegers) {
  EXPECT_EQ(read_integer(node("8"), "f", "k", 1, 30), 8);
  for (const std::string text : {"0", "31", "8.5", "x", "99999999999", "[8]"}) {
    EXPECT_TRUE(
        names(message_of([&] { read_integer(node(text), "f", "k", 1, 30); }), {"k: ", "an integer between 1 and 30"}));
  }
}

TEST(YamlFields, BoolsStringsAndChoices) {
  EXPECT_TRUE(read_bool(node("true"), "f", "k"));
  EXPECT_FALSE(read_bool(node("off"), "f", "k"));
  EXPECT_TRUE(names(message_of([] { read_bool(node("2"), "f", "k"); }), {"2", "true or false"}));
  EXPECT_EQ(read_string(node("a b"), "f", "k"), "a b");
  EXPECT_TRUE(
      names(message_of([] { read_string(node("[a]"), "f", "k"); }), {"k: invalid value '[a]': expected a string"}));
  EXPECT_EQ(read_choice(node("stop"), "f", "k", {"none", "stop"}), "stop");
  EXPECT_TRUE(names(message_of([] { read_choice(node("halt"), "f", "k", {"none", "stop"}); }), {"halt", "none, stop"}));
}

TEST(YamlFields, NumbersAsListOrString) {
  const std::vector<double> expected = {1.0, -2.5, 3e4};
  EXPECT_EQ(read_numbers(node("[1, -2.5, 3e4]"), "f", "k", 3), expected);
  EXPECT_EQ(read_numbers(node("1 -2.5 3e4"), "f", "k", 3), expected);
  for (const std::string text : {"[1, 2]", "[1, 2, 3, 4]", "1 2", "1 2 3 4", "1 2 x", "[1, 2, .nan]", "[1, 2, .inf]",
                                 "[1, 2, [3]]", "{a: 1}", "~"}) {
    EXPECT_TRUE(names(message_of([&] { read_numbers(node(text), "f", "k", 3); }), {"k: ", "3 finite numbers"})) << text;
  }
}

TEST(YamlFields, PosesAreNormalisedAndAZeroQuaternionIsRefused) {
  const RigidTransform X = read_pose(node("[1, 2, 3, 0, 0, 2, 2]"), "f", "k");
  EXPECT_TRUE(X.translation().isApprox(Vector3d(1, 2, 3)));
  EXPECT_TRUE((X.linear() * Vector3d::UnitX()).isApprox(Vector3d::UnitY()));
  EXPECT_TRUE(names(message_of([] { read_pose(node("[1, 2, 3, 0, 0, 0, 0]"), "f", "k"); }), {"quaternion"}));
  EXPECT_TRUE(names(message_of([] { read_pose(node("[1, 2, 3]"), "f", "k"); }), {"7 finite numbers"}));
}

TEST(YamlFields, UnknownKeysAreRefusedWithTheKnownOnes) {
  const YAML::Node map = node("a: 1\nbb: 2");
  EXPECT_NO_THROW(check_keys(map, "f", "", {"a", "bb", "c"}));
  EXPECT_TRUE(names(message_of([&] {
                      check_keys(map, "f", "top.", {"a", "c"});
                    }),
                    {"f:2: top.bb: unknown key", "a, c"}));
  EXPECT_TRUE(names(message_of([&] { check_keys(node("[1]"), "f", "", {}); }), {"a map"}));
  EXPECT_TRUE(names(message_of([&] { check_keys(node("[1, 2]: 3"), "f", "", {"a"}); }), {"unknown key"}));
}

TEST(YamlFields, LongValuesAreCutInMessages) {
  const std::string message = message_of([] { read_bool(node(std::string(10000, 'x')), "f", "k"); });
  EXPECT_LT(message.size(), 200u);
}

TEST(YamlFields, NoByteOfTheInputControlsATerminalOrEndsTheLine) {
  const test_support::TemporaryFolder folder;
  for (int c = 0; c < 128; ++c) {
    const std::string byte(1, static_cast<char>(c));
    EXPECT_NE(message_of([&] { read_bool(YAML::Node("a" + byte + "b"), "f", "k"); }), "") << c;
    YAML::Node map;
    map["a" + byte + "b"] = 1;
    EXPECT_NE(message_of([&] { check_keys(map, "f", byte, {"a"}); }), "") << c;
    folder.write("bad.yaml", "a: \"\\" + byte + "\nb: '" + byte);
    message_of([&] { load_yaml_file(folder.path("bad.yaml")); });
  }
  folder.write("bad.yaml", "a: \"\\\x1b\"");
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("bad.yaml")); }), {"bad.yaml:1", "not YAML"}));
}

TEST(LoadYamlFile, ReportsFileAndLineOfInvalidYaml) {
  const test_support::TemporaryFolder folder;
  folder.write("good.yaml", "a: 1\n");
  folder.write("empty.yaml", "");
  folder.write("bad.yaml", "a: 1\nb: [1, 2\nc: 3\n");
  EXPECT_EQ(load_yaml_file(folder.path("good.yaml"))["a"].as<int>(), 1);
  EXPECT_TRUE(load_yaml_file(folder.path("empty.yaml")).IsMap());
  folder.write("two.yaml", "a: 1\n---\nb: 2\n");
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("two.yaml")); }),
                    {"two.yaml: contains several YAML documents: expected one"}));
  folder.write("endless.yaml", ", a: 1\n");  // without end for yaml-cpp's LoadAll()
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("endless.yaml")); }),
                    {"endless.yaml: contains several YAML documents: expected one"}));
  folder.write("begun.yaml", "---\na: 1\n");
  EXPECT_EQ(load_yaml_file(folder.path("begun.yaml"))["a"].as<int>(), 1);
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("bad.yaml")); }), {"bad.yaml:", "not YAML"}));
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("nothing.yaml")); }),
                    {"nothing.yaml: expected a readable YAML file (No such file or directory)"}));
  EXPECT_NE(message_of([&] { load_yaml_file(folder.path("")); }), "") << "a folder";
}

TEST(LoadYamlFile, RefusesEndlessOrHugeAliases) {
  const test_support::TemporaryFolder folder;
  folder.write("endless.yaml", "a: &a {b: *a}\n");
  std::string immense = "a: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    immense += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
    for (int k = 1; k < 10; ++k) immense += ", " + last;
    immense += "]\n";
  }
  folder.write("immense.yaml", immense);
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("endless.yaml")); }), {"endless.yaml", "nesting"}));
  EXPECT_TRUE(names(message_of([&] { load_yaml_file(folder.path("immense.yaml")); }), {"immense.yaml", "size"}));
}

TEST(LoadYamlFile, AcceptsItsCapacityAndNoMore) {
  const test_support::TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    folder.write("file.yaml", text);
    return message_of([&] { load_yaml_file(folder.path("file.yaml")); });
  };
  EXPECT_EQ(message(std::string(95, '[') + std::string(95, ']')), "");
  EXPECT_TRUE(names(message(std::string(105, '[') + std::string(105, ']')), {"nesting", "100"}));
  const auto lists = [](int count) {  // of a thousand values each
    std::string text = "a: &a [1";
    for (int i = 1; i < 999; ++i) text += ",1";
    text += "]\nb: [*a";
    for (int i = 2; i < count; ++i) text += ",*a";
    return text + "]\n";
  };
  EXPECT_EQ(message(lists(950)), "");
  EXPECT_TRUE(names(message(lists(1050)), {"size", "1000000"}));
}

TEST(Join, PutsSeparatorsBetween) {
  EXPECT_EQ(validation::join({}), "");
  EXPECT_EQ(validation::join({"a"}), "a");
  EXPECT_EQ(validation::join({"a", "b", "c"}, "/"), "a/b/c");
}

}  // namespace
}  // namespace spring_workbench::config::yaml_fields_test
