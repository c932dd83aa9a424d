//! A TOML value as serde reads it, with errors that know their key.
//!
//! toml's own deserializer tells where in a text an error is, and `--set` leaves no text; its errors are texts besides.

use std::vec;

use serde::de::value::StringDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error as _, IntoDeserializer as _, MapAccess, SeqAccess, VariantAccess,
    Visitor,
};
use serde::forward_to_deserialize_any;
use toml::{Table, Value};

use super::misfit::Misfit;

type Result<T> = core::result::Result<T, Misfit>;

/// A value to be read.
pub(super) struct Reader(pub(super) Value);

impl<'de> Deserializer<'de> for Reader {
    type Error = Misfit;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match self.0 {
            Value::String(text) => visitor.visit_string(text),
            Value::Integer(number) => visitor.visit_i64(number),
            Value::Float(number) => visitor.visit_f64(number),
            Value::Boolean(value) => visitor.visit_bool(value),
            Value::Datetime(date) => visitor.visit_string(date.to_string()),
            Value::Array(values) => array(values, visitor),
            Value::Table(table) => visitor.visit_map(Entries { rest: table.into_iter(), entry: None }),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        match self.0 {
            Value::String(name) => visitor.visit_enum(Name(name)),
            Value::Table(table) => visitor.visit_enum(kind(table)?),
            other => Err(Misfit::wrong_kind(&other, "the name of one of its kinds, or a table")),
        }
    }

    /// By its keys alone: serde would also take an array, in the order in which the struct's fields are declared.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        match self.0 {
            Value::Array(_) => Err(Misfit::wrong_kind(&self.0, "a table")),
            _ => self.deserialize_any(visitor),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

fn array<'de, V: Visitor<'de>>(values: Vec<Value>, visitor: V) -> Result<V::Value> {
    let count = values.len();
    let mut elements = Elements { rest: values.into_iter(), index: 0 };
    let read = visitor.visit_seq(&mut elements)?;
    if elements.rest.len() > 0 {
        return Err(Misfit::invalid_length(count, &"fewer"));
    }
    Ok(read)
}

/// The elements of an array.
struct Elements {
    rest: vec::IntoIter<Value>,
    index: usize,
}

impl<'de> SeqAccess<'de> for &mut Elements {
    type Error = Misfit;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        let Some(value) = self.rest.next() else { return Ok(None) };
        let index = self.index;
        self.index += 1;
        seed.deserialize(Reader(value)).map(Some).map_err(|error| error.below(index.to_string()))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.rest.len())
    }
}

/// The entries of a table.
struct Entries {
    rest: toml::map::IntoIter<String, Value>,
    /// The one whose key has been read.
    entry: Option<(String, Value)>,
}

impl<'de> MapAccess<'de> for Entries {
    type Error = Misfit;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        let Some((key, value)) = self.rest.next() else { return Ok(None) };
        self.entry = Some((key.clone(), value));
        seed.deserialize(StringDeserializer::new(key)).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value> {
        // serde asks for a value after its key alone.
        let (key, value) = self.entry.take().ok_or_else(|| Misfit::custom("a value without a key"))?;
        seed.deserialize(Reader(value)).map_err(|error| error.below(key))
    }
}

/// A kind by its name alone: one that has no keys.
struct Name(String);

impl<'de> EnumAccess<'de> for Name {
    type Error = Misfit;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self)> {
        let name: StringDeserializer<Misfit> = self.0.clone().into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Name {
    type Error = Misfit;

    fn unit_variant(self) -> Result<()> {
        Ok(())
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, _: S) -> Result<S::Value> {
        Err(Misfit::bare_kind(self.0, &[]))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value> {
        Err(Misfit::bare_kind(self.0, &[]))
    }

    fn struct_variant<V: Visitor<'de>>(self, keys: &'static [&'static str], _: V) -> Result<V::Value> {
        Err(Misfit::bare_kind(self.0, keys))
    }
}

/// A table that names a kind: `{ kind = … }`.
struct Kind {
    name: String,
    value: Value,
}

fn kind(table: Table) -> Result<Kind> {
    let mut entries = table.into_iter();
    match (entries.next(), entries.next()) {
        (Some((name, value)), None) => Ok(Kind { name, value }),
        (None, _) => Err(Misfit::rule("must name a kind, not {}")),
        _ => Err(Misfit::rule("must be one kind alone: keep one of its tables")),
    }
}

impl<'de> EnumAccess<'de> for Kind {
    type Error = Misfit;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self)> {
        let name: StringDeserializer<Misfit> = self.name.clone().into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Kind {
    type Error = Misfit;

    fn unit_variant(self) -> Result<()> {
        match self.value {
            Value::Table(table) if table.is_empty() => Ok(()),
            other => Err(Misfit::wrong_kind(&other, "{}: it has no keys").below(self.name)),
        }
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value> {
        seed.deserialize(Reader(self.value)).map_err(|error| error.below(self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value> {
        Reader(self.value).deserialize_any(visitor).map_err(|error| error.below(self.name))
    }

    fn struct_variant<V: Visitor<'de>>(self, keys: &'static [&'static str], visitor: V) -> Result<V::Value> {
        let read = match self.value {
            Value::Table(_) => Reader(self.value).deserialize_any(visitor),
            other => Err(Misfit::no_table(&other, keys)),
        };
        read.map_err(|error| error.below(self.name))
    }
}
