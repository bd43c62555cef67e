"""A sign-in provider on localhost, as small as OpenID Connect lets it be: whoever is named in *address* signs in at once."""

from __future__ import annotations

import base64
import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import Any
from urllib.parse import parse_qs, urlencode, urlsplit

from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import padding, rsa

CLIENT, SECRET = "lipdb", "a-secret-of-the-tests"


class Provider(ThreadingHTTPServer):
    """Discovery, authorization, tokens signed with RS256, and the key to check them."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("localhost", 0), _Handler)
        self.url = f"http://localhost:{self.server_address[1]}"
        self.claims: dict[str, Any] = {}
        self.key = rsa.generate_private_key(public_exponent=65537, key_size=2048)
        self.codes: dict[str, dict[str, str]] = {}

    def token(self, code: str) -> str:
        """The signed token for whoever got *code*."""
        asked = self.codes.pop(code)
        now = int(time.time())
        claims = {"iss": self.url, "sub": self.claims["email"], "aud": CLIENT, "iat": now, "exp": now + 600, **self.claims}
        if "nonce" in asked:
            claims["nonce"] = asked["nonce"]
        parts = [_text(json.dumps(part).encode()) for part in ({"alg": "RS256", "typ": "JWT", "kid": "1"}, claims)]
        signature = self.key.sign(".".join(parts).encode(), padding.PKCS1v15(), hashes.SHA256())
        return ".".join([*parts, _text(signature)])

    def discovery(self) -> dict[str, Any]:
        """What the provider can do, and where."""
        return {
            "issuer": self.url,
            "authorization_endpoint": f"{self.url}/authorize",
            "token_endpoint": f"{self.url}/token",
            "jwks_uri": f"{self.url}/jwks",
            "userinfo_endpoint": f"{self.url}/userinfo",
            "response_types_supported": ["code"],
            "subject_types_supported": ["public"],
            "id_token_signing_alg_values_supported": ["RS256"],
        }

    def jwks(self) -> dict[str, Any]:
        """The public key."""
        numbers = self.key.public_key().public_numbers()
        n, e = (_text(number.to_bytes(-(-number.bit_length() // 8))) for number in (numbers.n, numbers.e))
        return {"keys": [{"kty": "RSA", "alg": "RS256", "use": "sig", "kid": "1", "n": n, "e": e}]}


class _Handler(BaseHTTPRequestHandler):
    server: Provider

    def do_GET(self) -> None:
        asked = urlsplit(self.path)
        if asked.path == "/authorize":
            wanted = {name: values[0] for name, values in parse_qs(asked.query).items()}
            code = f"code{len(self.server.codes)}{time.monotonic_ns()}"
            self.server.codes[code] = wanted
            self.send_response(302)
            self.send_header("Location", f"{wanted['redirect_uri']}?{urlencode({'code': code, 'state': wanted['state']})}")
            self.end_headers()
            return
        answers = {
            "/.well-known/openid-configuration": self.server.discovery,
            "/jwks": self.server.jwks,
            "/userinfo": lambda: {"sub": self.server.claims["email"], **self.server.claims},
        }
        self._answer(answers[asked.path]())

    def do_POST(self) -> None:
        sent = parse_qs(self.rfile.read(int(self.headers["Content-Length"])).decode())
        token = self.server.token(sent["code"][0])
        self._answer({"access_token": "access", "token_type": "Bearer", "expires_in": 600, "id_token": token})

    def _answer(self, content: dict[str, Any]) -> None:
        body = json.dumps(content).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:
        pass


def _text(content: bytes) -> str:
    return base64.urlsafe_b64encode(content).rstrip(b"=").decode()


@contextmanager
def provider() -> Iterator[Provider]:
    """A provider that answers until the block ends."""
    with Provider() as server:
        Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


def secrets(provider: Provider, port: int, **roles: list[str]) -> str:
    """The text of secrets.toml for a dashboard on *port*."""
    auth = {
        "redirect_uri": f"http://localhost:{port}/oauth2callback",
        "cookie_secret": "thirty-two-letters-and-some-more-of-them",
        "client_id": CLIENT,
        "client_secret": SECRET,
        "server_metadata_url": f"{provider.url}/.well-known/openid-configuration",
    }
    lines = ["[auth]", *(f"{name} = {json.dumps(value)}" for name, value in auth.items())]
    return "\n".join([*lines, "[lipdb]", *(f"{role} = {json.dumps(addresses)}" for role, addresses in roles.items())]) + "\n"
