# shellcheck shell=bash
# Which wheels a release has, and which Pythons of this machine build and test them; build-wheels.sh sources this at the
# top of the sources. pyproject.toml alone says which versions there are: N stands for a version 3.N.

give_up()
{
  echo "$*" >&2
  exit 1
}

# versions_in LINE: the numbers that such lines of pyproject.toml have, in order.
versions_in()
{
  sed -n "s/^$1\$/\\1/p" pyproject.toml | sort -n
}
oldest=$(versions_in 'requires-python = ">=3\.\([0-9]*\)"')
stable=$(versions_in 'wheel\.py-api = "cp3\([0-9]*\)"') # from here on, one wheel for all
newest=$(versions_in '  "Programming Language :: Python :: 3\.\([0-9]*\)",' | tail -1)
[[ $oldest && $stable && $newest ]] ||
  give_up "pyproject.toml lacks requires-python, wheel.py-api or the classifiers of versions, or has them in another form."

# look_at PYTHON: prints N and the interpreter itself, whatever stands before it; or why it is of no use.
look_at()
{
  "$1" - "$oldest" <<'PYTHON'
import os, sys, sysconfig
problem = None
if sys.implementation.name != "cpython":
    problem = "it is no CPython"
elif sys.version_info < (3, int(sys.argv[1])):
    problem = "it is too old"
elif sysconfig.get_config_var("Py_GIL_DISABLED"):
    problem = "it is free-threaded, and there are no wheels for that"
elif not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")):
    problem = "it lacks its headers"
else:
    try:
        import ensurepip, venv
    except ImportError:
        problem = "it lacks the module venv"
if problem:
    sys.exit(problem)
print(sys.version_info[1], getattr(sys, "_base_executable", sys.executable))
PYTHON
}

# find_pythons [PYTHON...]: sets `pythons`, interpreters by N; `builders`, those N for which a wheel is built; and
# `testers`, by the latter, the N which test it.
find_pythons()
{
  declare -gA pythons=() testers=()
  declare -ga builders=()
  local python found names candidates minor builder shared=
  if (($#)); then
    for python in "$@"; do
      found=$(look_at "$python" 2>&1) || give_up "$python cannot be used: ${found##*$'\n'}."
      pythons[${found%% *}]=${found#* }
    done
  else
    mapfile -t names < <(compgen -c python3. | grep -x 'python3\.[0-9]*' | sort -u)
    mapfile -t candidates < <(
      type -aP "${names[@]}"
      compgen -G "${PYENV_ROOT:-$HOME/.pyenv}/versions/*/bin/python3"
    )
    for python in "${candidates[@]}"; do
      if found=$(look_at "$python" 2>/dev/null) && [[ -z ${pythons[${found%% *}]:-} ]]; then
        pythons[${found%% *}]=${found#* }
      fi
    done
  fi
  for minor in $(printf '%s\n' "${!pythons[@]}" | sort -n); do
    builder=$minor
    if ((minor >= stable)); then
      builder=${shared:=$minor}
    fi
    [[ ${testers[$builder]:-} ]] || builders+=("$builder")
    testers[$builder]+="${testers[$builder]:+ }$minor"
  done
  if (($# == 0)); then
    for ((minor = oldest; minor <= stable; minor++)); do
      [[ ${pythons[$minor]:-} ]] || ((minor == stable && ${shared:-0})) ||
        give_up "No CPython 3.$minor with its headers is on PATH or in pyenv. Install it, or name the Pythons to build for."
    done
  fi
}

# tag_of BUILDER: the tag of its wheel, without the system's.
tag_of()
{
  if (($1 < stable)); then
    echo "cp3$1-cp3$1"
  else
    echo "cp3$stable-abi3"
  fi
}

print_untested()
{
  local minor
  for ((minor = oldest; minor <= newest; minor++)); do
    [[ ${pythons[$minor]:-} ]] || echo "Not tested: Python 3.$minor, which is not here."
  done
}
