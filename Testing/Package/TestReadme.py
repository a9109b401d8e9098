"""Follows the examples of the readme and of the guide, in the shell, in C++ and in Python, on an installed package.

  TestReadme.py DOCUMENTS PREFIX PYTHON_DESTINATION VTK_DIR CXX_COMPILER
"""

import os
import re
import subprocess
import sys
import tempfile


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def section(text, heading):
    """From a heading to the next."""
    return re.split("\n##+ ", text[text.index("\n" + heading + "\n") + 1:])[0]


def without(text, headings):
    for heading in headings:
        text = text.replace(section(text, heading), "")
    return text


def blocks(text, language):
    """The blocks of code in a language."""
    return re.findall("```" + language + "\n(.*?)```", text, re.DOTALL)


def block(text, heading, language):
    """The only one below a heading."""
    [only] = blocks(section(text, heading), language)
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


# The programs of a page share their variables; those of the sections named need packages of their own.
PAGES = {"shell.md": (), "python.md": ("## Without VTK", "## PyVista"), "README.md": (), "several-organs.md": (),
         "start-label-map.md": (), "label-surfaces.md": ("## From a label map to tetrahedra",), "vessels.md": ()}
RESULTS = {
    "shell.md": r"\nDice +0\.9[3-9]",
    "python.md": r"6144 vertices, 0 self.*\nScores\(dice=0\.9[3-9](.*\n)+"
                 r"converged \(6144, 3\) [0-9]+ voxels\n0\.9[3-9].*\nconverged 6144\n$",
    "README.md": r"Is the part of [0-9]+ ml at",
    "start-label-map.md": r"\n<Segmentation: [0-9.]+ ml, confidence [01]\.[0-9]+, [0-9]+ vertices, 0 self-intersections.*\n$",
    "label-surfaces.md": r"\n0 voxels on the wrong side",
}


def main(documents, prefix, python, vtk, compiler):
    text = text_of(documents, "README.md")
    environment = dict(os.environ, PATH=os.path.join(prefix, "bin") + ":" + os.environ["PATH"],
                       PYTHONPATH=os.path.join(prefix, python),
                       CMAKE_PREFIX_PATH=prefix, CXX=compiler)
    with tempfile.TemporaryDirectory(prefix="flipfree-readme-") as folder:
        output = run(["bash", "-e", "-c", block(text, "### Shell", "sh")], folder, environment)
        expect(r"\nDice +0\.9[3-9]", output)
        write(folder, "liver.cxx", block(text, "### C++", "cpp"))
        write(folder, "CMakeLists.txt", block(text, "### C++", "cmake"))
        run(["cmake", "-S", ".", "-B", "build", "-DVTK_DIR=" + vtk], folder, environment)
        run(["cmake", "--build", "build"], folder, environment)
        expect("^6144 vertices, a label map of [0-9]+ voxels, 0 self-intersections\n$",
               run(["build/liver"], folder, environment))
        expect(r"^converged \(6144, 3\) [0-9]+ voxels\n0\.94",
               run([sys.executable, "-c", block(text, "### Python", "python")], folder, environment))
        for page, elsewhere in PAGES.items():
            text = without(text_of(documents, "Examples", "Guide", page), elsewhere)
            lines = "".join(blocks(text, "sh")).replace("/usr/bin/python3", sys.executable)
            program = "\n".join(["import flipfree", *blocks(text, "python")])
            expect(RESULTS.get(page, ""), run(["bash", "-e", "-c", lines], folder, environment) +
                   run([sys.executable, "-c", program], folder, environment))


main(*sys.argv[1:])
