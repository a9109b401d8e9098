"""Writes type stubs for the modules of the package that have no types of their own to be read.

  GenerateStubs.py PACKAGE_FOLDER MODULE...

A module of wrapped classes is described by what its docstrings say, in which VTK's wrapping gives
the types; later versions of VTK do the same for vtkmodules. For a module in Python, the stub is its
source with the signatures that its functions have once it has been imported: there the keywords
that are a filter's properties are spelled out.
"""

import ast
import importlib
import inspect
import os
import re
import sys

HEADER = '"""Generated from the wrapped classes; do not edit."""\n\n'
ANCESTORS = ("vtkCommonCore", "vtkCommonDataModel", "vtkCommonExecutionModel")


def stub_of_wrapped(module):
    """The classes of a module of VTK's wrapping."""
    classes = [value for name, value in vars(module).items() if not name.startswith("_")]
    body = "\n\n".join(class_stub(wrapped) for wrapped in classes)
    imports = "from collections.abc import MutableSequence, Sequence\n" + imports_of(body, module)
    return f"{HEADER}{imports}\n{body}"


def class_stub(wrapped):
    lines = [
        f"class {wrapped.__name__}({wrapped.__base__.__name__}):",
        docstring(wrapped.__doc__, 4),
    ]
    for name, member in vars(wrapped).items():
        if isinstance(member, type):
            lines.append(f"    class {name}(int): ...")
        elif isinstance(member, int):
            kind = type(member).__name__
            lines.append(f"    {name}: {kind}")
        elif not name.startswith("_"):
            lines += method_stubs(name, member.__doc__)
    return "\n".join(lines) + "\n"


def method_stubs(name, text):
    """One method, or all its overloads; the documentation goes to the first."""
    signatures = signatures_in(text)
    if not signatures:
        sys.exit(f"GenerateStubs.py: no signature in the docstring of {name}:\n{text}")
    documentation = text.partition("\n\n")[2].strip()
    lines = []
    for index, (arguments, result) in enumerate(signatures):
        lines.append("    @overload" if len(signatures) > 1 else None)
        lines.append("    @staticmethod" if not arguments.startswith("self") else None)
        body = "" if documentation and index == 0 else " ..."
        lines.append(f"    def {name}({arguments}) -> {result}:{body}")
        lines.append(docstring(documentation, 8) if not body else None)
    return [line for line in lines if line is not None]


def signatures_in(text):
    """The arguments and the result of each signature, in the language of type hints.

    >>> signatures_in("Seed(self, label:int,\\n    seed:[float, float]) -> bool\\nC++: ...\\n\\nIs.")
    [('self, label: int, seed: MutableSequence[float]', 'bool')]
    >>> signatures_in("Set(self, a:(int, int)) -> None\\nC++: ...\\nGet(self) -> (int, int)\\nC++:")
    [('self, a: Sequence[int]', 'None'), ('self', 'tuple[int, int]')]
    """
    head = re.sub(r"\n\s+", " ", text.partition("\n\n")[0])
    signatures = []
    for line in head.splitlines():
        match = re.fullmatch(r"\w+\((.*)\) -> (.*)", line)
        if match and not line.startswith("C++:"):
            arguments = re.sub(r"\((\w+)(, [\w.]+)*\)", r"Sequence[\1]", match[1])
            arguments = re.sub(r":\[(\w+)(, [\w.]+)*\]", r":MutableSequence[\1]", arguments)
            result = re.sub(r"^\((.*)\)$", r"tuple[\1]", match[2])
            signatures.append((re.sub(r"(\w):(?=\w)", r"\1: ", arguments), result))
    return signatures


def imports_of(body, module):
    """Where the classes named in a stub come from."""
    homes = {}
    if "@overload" in body:
        homes["typing"] = {"overload"}
    for name in set(re.findall(r"\bvtk[A-Z]\w*", re.sub(r'""".*?"""', "", body, flags=re.DOTALL))):
        if hasattr(module, name):
            continue
        home = next((home for home in ANCESTORS if hasattr(vtk_module(home), name)), None)
        if home is None:
            home = next(home for home in vtk_modules() if hasattr(vtk_module(home), name))
        homes.setdefault("vtkmodules." + home, set()).add(name)
    return "".join(
        f"from {home} import {', '.join(sorted(names))}\n" for home, names in sorted(homes.items())
    )


def vtk_module(name):
    return importlib.import_module("vtkmodules." + name)


def vtk_modules():
    """Those that importing the package has brought along."""
    return sorted(
        name.partition(".")[2] for name in sys.modules if name.startswith("vtkmodules.vtk")
    )


def stub_of_python(module):
    """A module's imports, classes and public functions."""
    kept = []
    for statement in ast.parse(inspect.getsource(module)).body:
        if isinstance(statement, ast.FunctionDef):
            if not statement.name.startswith("_"):
                kept.append(function_stub(getattr(module, statement.name), statement))
        elif isinstance(statement, (ast.Import, ast.ImportFrom, ast.If, ast.ClassDef)):
            kept.append(ast.unparse(statement))
    return HEADER + "\n".join(kept) + "\n"


def function_stub(function, statement):
    arguments = []
    for parameter in inspect.signature(function).parameters.values():
        if parameter.kind is parameter.KEYWORD_ONLY and "*" not in arguments:
            arguments.append("*")
        default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
        stars = "**" if parameter.kind is parameter.VAR_KEYWORD else ""
        arguments.append(f"{stars}{parameter.name}: {parameter.annotation}{default}")
    text = (
        f"\ndef {function.__name__}({', '.join(arguments)}) -> {ast.unparse(statement.returns)}:\n"
    )
    return text + docstring(inspect.getdoc(function), 4) + "\n"


def docstring(text, indent):
    lines = text.strip().replace("\\", "\\\\").replace('"""', '\\"""').splitlines()
    margin = " " * indent
    return "\n".join(
        [
            f'{margin}"""{lines[0]}',
            *((margin + line).rstrip() for line in lines[1:]),
            f'{margin}"""',
        ]
    )


def main(folder, *names):
    sys.path.insert(0, os.path.dirname(folder))
    for name in names:
        module = importlib.import_module("flipfree." + name)
        is_python = os.path.splitext(module.__file__)[1] == ".py"
        stub = stub_of_python(module) if is_python else stub_of_wrapped(module)
        ast.parse(stub)  # so that a mistake in here is an error of the build
        path = os.path.join(folder, name + ".pyi")
        with open(path, "w", encoding="utf-8") as file:
            file.write(stub)


if __name__ == "__main__":
    main(*sys.argv[1:])
