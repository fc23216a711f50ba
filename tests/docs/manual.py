"""The man page and the completion made from --help hold every verb, flag and choice."""
import pathlib
import re
import subprocess
import sys
import tempfile

source, camber = pathlib.Path(sys.argv[1]), sys.argv[2]


def completed(script, *words):
    line = " ".join(f"'{word}'" for word in words)
    command = (f"source {script}; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _camber; "
               'printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-euc", command], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, source / "tools/make_man.py", camber, folder], check=True)
    page = (pathlib.Path(folder) / "camber.1").read_text().replace("\\-", "-")
    script = pathlib.Path(folder) / "camber.bash"
    verbs = completed(script, "camber", "") - {"--help", "--version"}
    assert {"curve", "check", "convert"} <= verbs, verbs
    for verb in sorted(verbs):
        assert f".SH CAMBER {verb.upper()}" in page, verb
        text = subprocess.run([camber, verb, "--help"], capture_output=True, text=True,
                              check=True).stdout
        flags = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE))
        assert len(flags) > 2, text
        for flag in flags:
            assert flag in page, (verb, flag)
        assert flags <= completed(script, "camber", verb, "--"), verb
    assert completed(script, "camber", "curve", "--smooth", "") == {"auto", "marching", "none"}
    assert completed(script, "camber", "cur") == {"curve"}
    assert re.search(r"^\.B 3\n.*certified", page, re.MULTILINE), "exit codes"
print("man page and completion are complete")
