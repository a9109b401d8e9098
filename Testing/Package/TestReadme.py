"""Follows the readme's first segmentation in the shell, in C++ and in Python, on an installed package.

  TestReadme.py README PREFIX PYTHON_DESTINATION VTK_DIR CXX_COMPILER
"""

import os
import re
import subprocess
import sys
import tempfile


def blocks(text, heading, language):
    """The blocks of code in a language below a heading."""
    section = text[text.index("\n" + heading + "\n") + 1:]
    section = re.split("\n##+ ", section)[0]
    return re.findall("```" + language + "\n(.*?)```", section, re.DOTALL)


def block(text, heading, language):
    """The only one."""
    [only] = blocks(text, heading, language)
    return only


def run(command, folder, environment):
    process = subprocess.run(command, cwd=folder, env=environment, text=True, timeout=300,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT)
    if process.returncode != 0:
        sys.exit(f"{command} failed ({process.returncode}):\n{process.stdout}")
    return process.stdout


def expect(pattern, output):
    if not re.search(pattern, output):
        sys.exit(f"'{pattern}' is not in:\n{output}")


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def main(readme, prefix, python, vtk, compiler):
    with open(readme, encoding="utf-8") as file:
        text = file.read()
    environment = dict(os.environ, PATH=os.path.join(prefix, "bin") + ":" + os.environ["PATH"],
                       PYTHONPATH=os.path.join(prefix, python),
                       CMAKE_PREFIX_PATH=prefix, CXX=compiler)
    with tempfile.TemporaryDirectory(prefix="flipfree-readme-") as folder:
        output = run(["bash", "-e", "-c", "".join(blocks(text, "### Shell", "sh"))], folder, environment)
        expect(r"\nDice +0\.9[3-9]", output)
        write(folder, "liver.cxx", block(text, "### C++", "cpp"))
        write(folder, "CMakeLists.txt", block(text, "### C++", "cmake"))
        run(["cmake", "-S", ".", "-B", "build", "-DVTK_DIR=" + vtk], folder, environment)
        run(["cmake", "--build", "build"], folder, environment)
        expect("^6144 vertices, a label map of [0-9]+ voxels, 0 self-intersections\n$",
               run(["build/liver"], folder, environment))
        layer, filters, correction, questions, labels = blocks(text, "### Python", "python")
        expect(r"(?m)^at rest \(6144, 3\) [0-9]+ voxels\n0\.9[3-9].*\n(.*\n)*<Segmentation: 6144 vertices, 0 self-inter",
               run([sys.executable, "-c", f"{layer}\n{correction}\n{questions}\nprint(better)"], folder, environment))
        expect("^at rest 6144\n$", run([sys.executable, "-c", filters], folder, environment))
        expect("<Segmentation: 6144 vertices, 0 self-intersections",
               run([sys.executable, "-c", f"import flipfree\n{labels}\nprint(liver)"], folder, environment))
        lines = block(text, "### Python", "sh").replace("/usr/bin/python3", sys.executable)
        expect(r"6144 vertices, 0 self.*\nScores\(dice=0\.9[3-9]",
               run(["bash", "-e", "-c", lines], folder, environment))


main(*sys.argv[1:])
