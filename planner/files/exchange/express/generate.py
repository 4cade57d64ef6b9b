#!/usr/bin/env python3
"""Turns EXPRESS schemas into the compact table of `dictionary.h`.

    generate.py SCHEMA.exp [SUPPLEMENT.exp ...] > ap238.table

Later files may add declarations and extend extensible types; a name declared twice is an error. Only what a
reader of Part 21 needs is kept: entities with their supertypes, explicit attributes and redeclarations; types.
Rules, functions and constants are skipped. The output depends on the input alone.

One declaration per line, sorted by kind and by name as Part 21 spells it, in upper case (so that the order of
entities is that of the parts of complex instances):

    entity NAME [abstract] : SUPERTYPE ... ; ATTRIBUTE TYPE ; ATTRIBUTE ? TYPE ; SUPERTYPE\\ATTRIBUTE[=NEW] TYPE ;
                             * SUPERTYPE\\ATTRIBUTE ; ! SUBTYPE ...      (of these only one: ONEOF)
    enum NAME = ITEM ...          select NAME = ITEM ...          type NAME = TYPE [in [0,24)]
    TYPE: NAME | integer | real | number | string | boolean | logical | binary
          | (list|set|bag|array) LOWER:UPPER [unique] [optional] TYPE          UPPER ? is unbounded
"""

import re
import sys

TOKEN = re.compile(r"\s+|--[^\n]*|'(?:[^']|'')*'|[A-Za-z]\w*|\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|<=|>=|<>|:=:|:<>:|:=|<\*|\|\||\*\*|.",
                   re.S)
BASIC = "integer real number string boolean logical binary".split()
AGGREGATE = "list set bag array".split()


def without_remarks(text):
    """EXPRESS remarks (* ... *) may nest."""
    out, depth, start = [], 0, 0
    for m in re.finditer(r"\(\*|\*\)", text):
        if m.group() == "(*":
            if depth == 0:
                out.append(text[start:m.start()])
            depth += 1
        elif depth:
            depth -= 1
            start = m.end()
    out.append(text[start:])
    return " ".join(out)


def tokens_of(text):
    tokens = []
    for t in TOKEN.findall(without_remarks(text)):
        if not t.isspace() and not t.startswith("--"):
            tokens.append(t if t.startswith("'") else t.lower())
    return tokens


def range_of(where):
    """" in [0,24)" where the rules bound SELF by numbers; empty where they say something else."""
    text = " ".join(t for t in where if t not in "()")
    lower, upper, ends = "?", "?", ["(", ")"]
    number = r"(\d+(?:\.\d*)?)"
    if m := re.fullmatch(rf"; where \w+ : self = {number} or self = {number} ;", text):
        return f" in [{m[1]},{m[2]}]"  # of whole numbers, neighbours
    found = [(m[1], m[2]) for m in re.finditer(rf"(?<!length )self (>=?|<=?) {number}", text)]
    found += [(m[2].replace("<", ">"), m[1]) for m in re.finditer(rf"{number} (<=?) self", text)]
    for op, value in found:
        value = value.removesuffix(".0")
        if op[0] == ">":
            lower, ends[0] = value, "[" if op == ">=" else "("
        else:
            upper, ends[1] = value, "]" if op == "<=" else ")"
    return "" if lower == upper == "?" else f" in {ends[0]}{lower},{upper}{ends[1]}"


def one_of(expression):
    """The groups ONEOF (a, b, ...) of a supertype expression, as far as their members are names."""
    groups, at = [], 0
    while "oneof" in expression[at:]:
        at = expression.index("oneof", at) + 2
        depth, member, members = 0, [], []
        while depth >= 0:
            token = expression[at]
            at += 1
            depth += {"(": 1, ")": -1}.get(token, 0)
            if depth < 0 or (depth == 0 and token == ","):
                members += member if len(member) == 1 else []
                member = []
            else:
                member.append(token)
        if len(members) > 1:
            groups.append(members)
    return groups


class Reader:
    def __init__(self, tables, tokens):
        self.t, self.i = tokens, 0
        self.tables = tables

    def peek(self):
        return self.t[self.i] if self.i < len(self.t) else ""

    def next(self):
        self.i += 1
        return self.t[self.i - 1]

    def take(self, token):
        if self.peek() != token:
            return False
        self.i += 1
        return True

    def want(self, token):
        if not self.take(token):
            sys.exit(f"expected {token!r}, found {' '.join(self.t[self.i:self.i + 12])!r}")

    def until(self, *ends):
        """The tokens before the first of `ends` outside parentheses."""
        start, depth = self.i, 0
        while depth or self.peek() not in ends:
            depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(self.next(), 0)
        return self.t[start:self.i]

    def schema(self):
        while self.i < len(self.t):
            word = self.next()
            if word == "entity":
                self.entity()
            elif word == "type":
                self.type_declaration()
            elif word in ("function", "procedure", "rule", "constant", "subtype_constraint"):
                while self.next() != "end_" + word:
                    pass

    def bound(self, tokens):
        return tokens[0] if len(tokens) == 1 and (tokens[0].isdigit() or tokens[0] == "?") else None

    def type(self):
        word = self.next()
        if word in AGGREGATE:
            lower, upper = "0", "?"
            if self.take("["):
                lower = self.bound(self.until(":")) or "0"
                self.want(":")
                upper = self.bound(self.until("]")) or "?"
                self.want("]")
            self.want("of")
            flags = [f for f in ("optional", "unique", "optional") if self.take(f)]
            return " ".join([word, f"{lower}:{upper}", *flags, self.type()])
        if word in BASIC and self.take("("):
            self.until(")")
            self.want(")")
        self.take("fixed")
        return word

    def type_declaration(self):
        name = self.next()
        self.want("=")
        extensible = self.take("extensible")
        self.take("generic_entity")
        if self.peek() in ("enumeration", "select"):
            kind = "enum" if self.next() == "enumeration" else "select"
            self.take("of")
            base = self.next() if self.take("based_on") else None
            self.take("with")
            items = []
            if self.take("("):
                items = [t for t in self.until(")") if t != ","]
                self.want(")")
            self.define(kind, name, (items, base, extensible))
        else:
            kind = self.type()
            self.define("type", name, kind + range_of(self.where("end_type")))
            return
        while self.next() != "end_type":
            pass

    def where(self, end):
        """The tokens of the WHERE rules before `end`."""
        tokens = []
        while self.peek() != end:
            tokens.append(self.next())
        self.want(end)
        return tokens

    def define(self, kind, name, what):
        if any(name in table for table in self.tables.values()):
            sys.exit(f"{name} is declared twice")
        self.tables[kind][name] = what

    def attribute_names(self):
        """NAME, ... : with redeclarations SELF\\SUPERTYPE.NAME [RENAMED NEW] kept as SUPERTYPE\\NAME[=NEW]."""
        names = []
        while True:
            name = self.next()
            if name == "self":
                self.want("\\")
                name = self.next()
                self.want(".")
                name += "\\" + self.next()
                if self.take("renamed"):
                    name += "=" + self.next()
            names.append(name)
            if not self.take(","):
                break
        self.want(":")
        return names

    def entity(self):
        name, abstract, supers, parts, exclusive = self.next(), False, [], [], []
        while not self.take(";"):
            word = self.next()
            if word == "abstract":
                abstract = True
            elif word == "subtype":
                self.want("of")
                self.want("(")
                supers = [t for t in self.until(")") if t != ","]
            elif word == "supertype" and self.take("of"):
                self.want("(")
                exclusive = one_of(self.until(")"))
        while self.peek() not in ("derive", "inverse", "unique", "where", "end_entity"):
            names = self.attribute_names()
            optional = "? " if self.take("optional") else ""
            kind = self.type()
            parts += [f"{n} {optional}{kind}" for n in names]
            self.want(";")
        if self.take("derive"):
            while self.peek() not in ("inverse", "unique", "where", "end_entity"):
                names = self.attribute_names()
                self.until(";")
                self.want(";")
                parts += [f"* {n}" for n in names if "\\" in n]
        while self.next() != "end_entity":
            pass
        parts += ["! " + " ".join(group) for group in exclusive]
        self.define("entity", name, (abstract, supers, parts))


def flattened(table):
    """Items of extensible types: what extends them belongs to them, and they to what is based on them."""
    out = {n: list(items) for n, (items, _, _) in table.items()}
    for name, (items, _, _) in table.items():
        base = table[name][1]
        while base:
            out[base] += [i for i in items if i not in out[base]] if table[base][2] else []
            out[name] += [i for i in table[base][0] if i not in out[name]]
            base = table[base][1]
    return out


def in_order(table):
    return sorted(table.items(), key=lambda item: item[0].upper())


def main(paths):
    tables = {"entity": {}, "enum": {}, "select": {}, "type": {}}
    for path in paths:
        with open(path, encoding="latin-1") as file:
            Reader(tables, tokens_of(file.read())).schema()
    known = {n for t in tables.values() for n in t} | set(BASIC) | set(AGGREGATE)
    lines = []
    for name, (abstract, supers, parts) in in_order(tables["entity"]):
        head = f"entity {name}{' abstract' if abstract else ''} : {' '.join(supers)}".rstrip()
        for word in supers + [p.split()[-1] for p in parts if p[0] not in "*!"]:
            if word not in known:
                sys.exit(f"{name} names {word}, which is not declared")
        lines.append(" ; ".join([head, *parts]))
    for kind in ("enum", "select"):
        for name, items in in_order(flattened(tables[kind])):
            lines.append(" ".join([kind, name, "=", *(items if kind == "enum" else sorted(items))]))
            missing = [i for i in items if kind == "select" and i not in known]
            if missing:
                sys.exit(f"{name} names {missing}, which is not declared")
    for name, kind in in_order(tables["type"]):
        lines.append(f"type {name} = {kind}")
    print("# Generated by generate.py; see there for the form.")
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
