"""Builds the wheel (PEP 517) with what the system has: CMake, pybind11 and the library.

The library is the installed one (libmeninas-dev), or, in a checkout, the one that `cmake --install` lays down; then it is part of
the wheel, beside the extension module.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def _run(*command):
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stdout)
        raise SystemExit(f"meninas: {command[0]} has failed")


def _installed_tree(scratch):
    """Where the library is installed for this wheel alone; None: the system's is used."""
    given = os.environ.get("MENINAS_BUILD")
    if not given and not (ROOT / "CMakePresets.json").exists():
        return None
    build = pathlib.Path(given or ROOT / "build" / "release")
    if not given:
        _run(ROOT / "meninas", "version")
    _run("cmake", "--install", build, "--prefix", scratch / "tree")
    return scratch / "tree"


def _files(scratch):
    """What the package consists of, by its place in the wheel."""
    tree = _installed_tree(scratch)
    options = [f"-DPython_EXECUTABLE={sys.executable}", f"-DPYTHON_EXECUTABLE={sys.executable}"]
    if tree:
        options += [f"-DCMAKE_PREFIX_PATH={tree}", "-DMENINAS_RPATH=$ORIGIN"]
    _run("cmake", "-S", HERE, "-B", scratch / "build", "-G", "Ninja", *options)
    _run("cmake", "--build", scratch / "build")
    files = {f"meninas/{file.name}": file for file in sorted((HERE / "src" / "meninas").iterdir()) if file.is_file()}
    files.update({f"meninas/{file.name}": file for file in (scratch / "build").glob("_meninas*.so")})
    if (ROOT / "LICENSE").exists():
        files["meninas/LICENSE"] = ROOT / "LICENSE"
    if tree:
        library = next(file for file in tree.rglob("libmeninas.so.*") if not file.is_symlink())
        soname = ".".join(library.name.split(".")[:4])
        files[f"meninas/{soname}"] = library
        for module in tree.rglob("meninas_decoder.so"):
            files["meninas/meninas/" + module.name] = module
    return files


def _version():
    if "MENINAS_VERSION" in os.environ:
        return os.environ["MENINAS_VERSION"]
    listing = ROOT / "CMakeLists.txt"
    if listing.exists():
        return re.search(r"project\(meninas VERSION ([0-9.]+)", listing.read_text()).group(1)
    return subprocess.run(["meninas", "--version"], capture_output=True, text=True, check=True).stdout.split()[1]


class UnsupportedOperation(Exception):
    """As PEP 517 asks for it."""


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("the sources are the whole checkout")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version = _version()
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    info = f"meninas-{version}.dist-info"
    name = f"meninas-{version}-{python}-{python}-{platform}.whl"
    texts = {
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: meninas\nVersion: {version}\n"
                            "Summary: Noise-free rendering of rooms with mirrors\nRequires-Python: >=3.9\nRequires-Dist: numpy<2\n",
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: meninas\nRoot-Is-Purelib: false\nTag: {python}-{python}-{platform}\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        contents = {place: file.read_bytes() for place, file in _files(scratch).items()}
    contents.update({place: text.encode() for place, text in texts.items()})
    record = ""
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for place, data in contents.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{place},sha256={digest},{len(data)}\n"
            wheel.writestr(place, data)
        wheel.writestr(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    return name
