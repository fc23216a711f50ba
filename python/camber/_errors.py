"""The errors of Camber: what went wrong, where, and what to do about it."""


class Error(Exception):
    """Base of all errors that Camber raises.

    Attributes:
        what: what went wrong.
        where: file, place or option.
        remedy: what to do about it.
    """

    def __init__(self, what: str, where: str, remedy: str) -> None:
        super().__init__(what, where, remedy)
        self.what = what
        self.where = where
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.where}: {self.what}; {self.remedy}"


class FileError(Error):
    """A file cannot be read or written, or its content breaks its format."""


class MeshError(Error):
    """The mesh cannot be used: inverted cells, indices out of range, no volume cells, ..."""


class GeometryError(Error):
    """The CAD cannot be used, or does not fit the mesh."""


class OptionError(Error):
    """An option is unknown, out of range or contradicts another one."""
