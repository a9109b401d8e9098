"""The manual page and the completion of shells name exactly the options that --help names."""

import os
import pty
import re
import select
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import command

SUBCOMMANDS = ("segment", "trace", "surfaces", "evaluate", "series", "phantom")


def generated(kind):
    process = command.run("--generate", kind)
    if process.returncode != 0 or process.stderr:
        raise AssertionError(process.stderr)
    return process.stdout


def options_of_help(*subcommand):
    """What a help lists in its first column."""
    text = command.run(*subcommand, "--help").stdout
    lines = re.findall(r"^  (-.*?)(?:  |$)", text, re.MULTILINE)
    return {name for line in lines for name in re.findall(r"(?<![^ ,!])--?[a-z][a-z-]*",
                                                          line.replace("!", " "))}


class TestManual(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_help_lists_options(self):
        """Or else the comparisons below compare nothing."""
        self.assertEqual(options_of_help(), {"-h", "--help", "--version"})
        for option in ("--seed", "--no-guard", "-o", "--output"):
            self.assertIn(option, options_of_help("segment"))

    def test_the_option_behind_it_is_hidden_and_strict(self):
        self.assertNotIn("generate", command.run("--help").stdout)
        self.assertEqual(command.run("--generate", "poetry").returncode, 2)

    def test_manual_page_names_all_options(self):
        page = generated("man").replace("\\-", "-")
        sections = re.split(r"^\.SS \\fBflipfree (\w+)", page, flags=re.MULTILINE)
        self.assertEqual(tuple(sections[1::2]), SUBCOMMANDS)
        for name, section in zip(sections[1::2], sections[2::2]):
            self.assertEqual(set(re.findall(r"\\fB(-[a-z-]+)\\fR", section)),
                             options_of_help(name))

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_manual_page_is_well_formed(self):
        page = self.write("flipfree.1", generated("man"))
        process = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-P-c", page],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        for line in ("NAME", "SYNOPSIS", "SUBCOMMANDS", "--seed X Y Z", "Examples:"):
            self.assertIn(line, re.sub(".\b", "", process.stdout))

    def complete_in_bash(self, *words):
        """What bash offers after the words, the last of which is being typed."""
        script = self.write("completion", generated("bash"))
        process = subprocess.run(
            ["bash", "--norc", "-euc",
             'compopt() { :; }; source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1));'
             ' _flipfree; printf "%s\\n" "${COMPREPLY[@]}"', "-", script, "flipfree", *words],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return set(process.stdout.split("\n")) - {""}

    def test_bash_completes_all_options(self):
        self.assertEqual(self.complete_in_bash(""), set(SUBCOMMANDS))
        self.assertEqual(self.complete_in_bash("-"), options_of_help())
        for name in SUBCOMMANDS:
            self.assertEqual(self.complete_in_bash(name, "-"), options_of_help(name))

    def test_bash_completes_values(self):
        self.write("ct of liver.nii.gz", "")
        os.mkdir(os.path.join(self.folder, "dicom"))
        files = {"ct of liver.nii.gz", "dicom", "completion"}
        self.assertEqual(self.complete_in_bash("segment", ""), files)
        self.assertEqual(self.complete_in_bash("segment", "c"), files - {"dicom"})
        self.assertEqual(self.complete_in_bash("segment", "ct", "--preset", ""),
                         {"default", "published", "naive"})
        self.assertEqual(self.complete_in_bash("segment", "ct", "--seed", "1", "-2", ""), set())
        self.assertIn("--radius",
                      self.complete_in_bash("segment", "ct", "--seed", "1", "-2", "3", ""))
        self.assertEqual(self.complete_in_bash("segment", "ct", "-o", "ct"),
                         {"ct of liver.nii.gz"})
        self.assertEqual(self.complete_in_bash("evaluate", "a", ""), files)
        self.assertEqual(self.complete_in_bash("phantom", "c"), {"cube", "cup"})
        self.assertEqual(self.complete_in_bash("phantom", "cup", "-o", ""), {"dicom"})

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_takes_all_options(self):
        """Its own functions tell what they are given."""
        script = self.write("_flipfree", generated("zsh"))
        for name in SUBCOMMANDS:
            process = subprocess.run(
                ["zsh", "-fc", "compdef() {}; _describe() {}; _arguments() { print -rl -- $@;"
                 " state=argument; line=($name) }; name=$2; source $1; _flipfree", "-", script,
                 name], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            specifications = process.stdout.split("*::argument:->argument\n")[1]
            self.assertEqual(set(re.findall(r"^\([^)]*\)(-[a-z-]+)\[", specifications,
                                            re.MULTILINE)), options_of_help(name))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_completes_at_the_prompt(self):
        self.write("_flipfree", generated("zsh"))
        functions = subprocess.check_output(["zsh", "-fc", "print -r $FPATH"], text=True).strip()
        process, terminal = pty.fork()
        if process == 0:
            os.environ.update(TERM="dumb", PS1="READY>", FPATH=self.folder + ":" + functions)
            os.execlp("zsh", "zsh", "-f")
        self.addCleanup(os.waitpid, process, 0)
        self.addCleanup(os.kill, process, signal.SIGKILL)

        def read_until(pattern):
            seen = ""
            end = time.monotonic() + 30 * command.SLOWNESS
            while not re.search(pattern, seen):
                ready = select.select([terminal], [], [], max(0, end - time.monotonic()))[0]
                self.assertTrue(ready, f"no {pattern} in: {seen}")
                seen += os.read(terminal, 4096).decode()
            return seen

        read_until("READY>")
        os.write(terminal, b"autoload -U compinit; compinit -D -u; print RE''START\n")
        read_until("RESTART")
        os.write(terminal, b"flipfree phantom u\t")
        read_until("phantom u-tube ")


if __name__ == "__main__":
    unittest.main()
