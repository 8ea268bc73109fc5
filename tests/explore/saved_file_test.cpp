// SPDX-License-Identifier: MIT
// What scripts may write, that what is written holds no instruction for another program, and which
// line of a script is named where its work fails.
#include "app/session/script.h"

#include <cstdlib>
#include <filesystem>

#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

class SavedFile : public SessionFixture {
 protected:
  SavedFile() { fs::create_directories(place()); }

  std::string place(const std::string& name = "") const { return folder() + "files/" + name; }

  static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  /// Runs a script of these lines in a session of its own, as it comes from somebody else.
  Result<void> run_foreign(const std::string& lines) {
    write(place("foreign.geotherm"), lines);
    Session other;
    return other.submit(command::Run{place("foreign.geotherm")});
  }

  /// The script is refused with one line that holds `part`, and the file keeps what it holds.
  void expect_kept(const std::string& line, const std::string& path, const std::string& part) {
    const std::string before = text_of(path);
    const auto ran = run_foreign("open " + small_model() + "\nsource set 5\n" + line + "\n");
    ASSERT_FALSE(ran) << line;
    EXPECT_NE(sentence(ran.error()).find(part), std::string::npos) << ran.error().message;
    EXPECT_EQ(sentence(ran.error()).find('\n'), std::string::npos);
    EXPECT_EQ(text_of(path), before);
  }
};

TEST_F(SavedFile, OfAScriptIsNeverHiddenOrOfAnotherKind) {
  for (const char* const name : {".bashrc", ".x.geotherm", "notes.txt", "run.sh", "Makefile"}) {
    write(place(name), "mine\n");
    for (const char* const what : {"session", "log", "figures"}) {
      const bool hidden = *name == '.';
      expect_kept(std::string("save ") + what + ' ' + place(name), place(name),
                  hidden ? "hidden" : "written as ");
    }
  }
  expect_kept("save distances " + place("run.sh"), place("run.sh"), ".csv .npy .ply .vtp");
  expect_kept("save picture " + place("run.sh"), place("run.sh"), "written as .png");
}

TEST_F(SavedFile, OfAUserIsOfItsKindAsWell) {
  EXPECT_FALSE(session.submit(command::SaveLog{place("run.sh")}));
  EXPECT_FALSE(session.submit(command::SaveSession{place(".geotherm")}));
  EXPECT_FALSE(session.submit(command::SaveLog{"-"}));
  EXPECT_TRUE(fs::is_empty(place()));
}

TEST_F(SavedFile, OfAScriptReplacesNothingThatGeothermDidNotWrite) {
  for (const char* const name : {"a.geotherm", "a.csv", "a.ply", "a.vtp", "a.npy", "a.json"}) {
    write(place(name), "mine\n");
  }
  const std::string there = "is there already";
  expect_kept("save session " + place("a.geotherm"), place("a.geotherm"), there);
  expect_kept("save log " + place("a.geotherm"), place("a.geotherm"), there);
  expect_kept("save figures " + place("a.json"), place("a.json"), there);
  for (const char* const name : {"a.csv", "a.ply", "a.vtp", "a.npy"}) {
    expect_kept("save distances " + place(name), place(name), there);
  }
}

TEST_F(SavedFile, OfAScriptReplacesWhatItWroteItself) {
  std::string lines = "open " + small_model() + "\nsource set 5\nsave session " +
                      place("s.geotherm") + "\nsave log " + place("l.geotherm") +
                      "\nsave figures " + place("f.json") + "\n";
  for (const char* const name : {"d.csv", "d.ply", "d.vtp", "d.npy"}) {
    lines += "save distances " + place(name) + "\n";
  }
  const auto ran = run_foreign(lines + lines);
  EXPECT_TRUE(ran) << ran.error().message;
}

TEST_F(SavedFile, OfAScriptReplacesNothingOfARunBefore) {
  const std::pair<const char*, const char*> saved[] = {
      {"session", "s.geotherm"}, {"log", "l.geotherm"},  {"figures", "f.json"},
      {"distances", "d.csv"},    {"distances", "d.ply"}, {"distances", "d.vtp"},
      {"distances", "d.npy"}};
  for (const auto& [what, name] : saved) {
    const std::string line = std::string("save ") + what + ' ' + place(name);
    const auto ran = run_foreign("open " + small_model() + "\nsource set 5\n" + line + "\n");
    ASSERT_TRUE(ran) << ran.error().message;
    expect_kept(line, place(name), std::string(name) + ": is there already");
  }
}

TEST_F(SavedFile, OfAScriptReplacesNothingThatItsUserSaved) {
  ASSERT_TRUE(session.submit(command::SaveLog{place("a.geotherm")}));
  const std::string before = text_of(place("a.geotherm"));
  write(place("foreign.geotherm"), "save session " + place("a.geotherm") + "\n");
  EXPECT_FALSE(session.submit(command::Run{place("foreign.geotherm")}));
  EXPECT_EQ(text_of(place("a.geotherm")), before);
}

TEST_F(SavedFile, IsInNoHiddenFolder) {
  fs::create_directories(place(".ssh/deep"));
  fs::create_directory_symlink(place(".ssh"), place("link"));
  for (const char* const folder : {".ssh/", ".ssh/deep/", "link/"}) {
    for (const char* const name : {"log x.geotherm", "figures x.json", "distances x.csv"}) {
      std::string line = std::string("save ") + name;
      const std::size_t at = line.rfind(' ') + 1;
      const std::string path = place(folder) + line.substr(at);
      expect_kept(line.replace(at, std::string::npos, path), path, "hidden folders");
      EXPECT_FALSE(fs::exists(path));
    }
  }
  const auto saved = session.submit(command::SaveLog{place("./x.geotherm")});
  EXPECT_TRUE(saved) << saved.error().message;
}

TEST_F(SavedFile, OfAUserReplacesWhatIsThere) {
  write(place("a.geotherm"), "mine\n");
  ASSERT_TRUE(session.submit(command::SaveLog{place("a.geotherm")}));
  EXPECT_NE(text_of(place("a.geotherm")), "mine\n");
}

TEST_F(SavedFile, IsNotReachedThroughALink) {
  write(place(".profile"), "mine\n");
  fs::create_symlink(place(".profile"), place("a.geotherm"));
  expect_kept("save log " + place("a.geotherm"), place(".profile"), "leads by a link to ");
  EXPECT_FALSE(session.submit(command::SaveLog{place("a.geotherm")}));
  EXPECT_EQ(text_of(place(".profile")), "mine\n");
}

TEST_F(SavedFile, HoldsNoInstructionForAShell) {
  const std::string name = place("$(>done)`>done`;>done\n>done\n'; >done\n");
  fs::copy_file(small_model(), name + ".ply");
  ASSERT_TRUE(session.submit(command::Open{name + ".ply"}));
  ASSERT_FALSE(session.submit(command::Open{name + ".obj"}));  // a comment of the log
  const std::string saved = place("s.geotherm"), log = place("l.geotherm");
  ASSERT_TRUE(session.submit(command::SaveSession{saved}));
  ASSERT_TRUE(session.submit(command::SaveLog{log}));
  // Without other programs: a name that is taken for an instruction makes a file by itself.
  const auto status_in_shell = [this](const std::string& file) {
    const std::string line =
        "cd '" + place() + "' && PATH=/none /bin/sh '" + file + "' 2>/dev/null";
    return std::system(line.c_str());
  };
  for (const std::string& file : {saved, log}) {
    EXPECT_EQ(status_in_shell(file), 0) << "a shell found a command in " << file;
    std::string text = text_of(file);
    text.erase(text.find(kInertLine), std::string(kInertLine).size());
    write(place("bare"), text);
    EXPECT_NE(status_in_shell(place("bare")), 0) << "the words stood behind the line for shells";
    EXPECT_FALSE(fs::exists(place("done"))) << file;
  }
  Session again;
  ASSERT_TRUE(again.submit(command::Run{saved}));
  EXPECT_EQ(again.state(), session.state());
}

TEST_F(SavedFile, OfAScriptIsKnownBeforeItRuns) {
  write(place("inner.geotherm"), "run " + place("outer.geotherm") + "\nsave log b.geotherm\n");
  write(place("outer.geotherm"), "open bunny\nsave picture a.png\nrun " + place("inner.geotherm") +
                                     "\nsave picture a.png\nsave distances d.csv\n");
  EXPECT_EQ(files_written_by(place("outer.geotherm")),
            (std::vector<std::string>{"a.png", "d.csv", "b.geotherm"}));
  EXPECT_TRUE(files_written_by(place("none.geotherm")).empty());
}

TEST_F(SavedFile, OfCommandsSaysTheLineWhoseWorkFails) {
  const std::string path = folder() + "bad.geotherm";
  const std::string open = "open " + small_model() + "\n";
  write(folder() + "other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"open nosuch.obj\nazimuth 30\n", "line 1: "},
      {open + "source set 999999\ntarget 5\nview flat\n", "line 2: source 999999: there is no"},
      {open + "source set 5\nsource set 5@0.5\nazimuth 30\n", "line 3: "},
      {open + "sequence " + folder() + "other.obj\nsource set 5\n", "line 2: "},
      {open + "# a comment\nfield nosuch.npy\nview contours\n", "line 3: "},
      {open + "source set 5\nsculpt pull 0.1 0.5 face:99999:1:0:0\nsource set 7\n",
       "line 3: there is no face 99999 to sculpt"},
      {open + "source set 999999\nweld 0\n", "line 2: source 999999: there is no"},
      {open + "source add 999999\nsource add 7\n", "lines 2 to 3: source 999999: there is no"},
      {open + "source set 999999\nsource set 5\nundo\n", "line 4: source 999999: there is no"},
      {open + "source set 5@0.5\nmethod heat\nazimuth 30\n", "lines 2 to 3: "},
      {open + "source set 5\npick face:99999:1:0:0\nview flat\n",
       "line 3: pick: there is no face 99999; faces are 0 to "},
  };
  for (const auto& [script, what] : wrong) {
    write(path, script);
    Session fresh;
    const auto ran = fresh.submit(command::Run{path});
    ASSERT_FALSE(ran) << what;
    EXPECT_NE(sentence(ran.error()).find("bad.geotherm: " + what), std::string::npos)
        << sentence(ran.error());
  }
  write(path, open + "source set 5\n");
  Session mine;
  ASSERT_TRUE(mine.submit(command::Run{path}));
  const auto refused = mine.submit(*parse_command("source set 999999"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(sentence(refused.error()).find("line"), std::string::npos) << "no script asked for it";
  EXPECT_NE(sentence(mine.submit(*parse_command("pick face:99999:1:0:0")).error())
                .find("there is no face 99999"),
            std::string::npos);
}

}  // namespace
}  // namespace geotherm::app
